#include "server/cluster/node.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "server/access/resume_token.h"
#include "shared/core/joined.h"

namespace woodlouse::server {

using core::joined;

namespace {

constexpr std::uint64_t kMostPassedOver = 64;  // batches in a row that are none

}  // namespace

/// True: the log is this host's. False: the node ends.
bool Node::follow() {
  view_.reset();
  has_differed_ = false;
  begin_at_ = tried_ = Time{};
  heard_ = Clock::now();
  Time looked = heard_;
  while (!inbox_->is_stopping()) {
    if (renew_log_link()) view_.reset();
    tell_line();
    if (!view_ && Clock::now() >= begin_at_ && !begin_following()) view_.reset();
    for (NodeEvent& event : inbox_->take(Clock::now() + 4 * kLook)) {
      const auto* message = std::get_if<LogMessage>(&event);
      if (message != nullptr && view_ && !take_message(*message)) view_.reset();
    }
    const Time now = Clock::now();
    // Who was away himself, or cut off, has heard nobody.
    if (now - std::exchange(looked, now) > settings_.silence / 2 || is_cut_off()) heard_ = now;
    if (view_ && is_log_empty_ && table().owner(now)) view_.reset();  // somebody has begun it
    if (view_ && has_log_gone_back(now)) view_.reset();
    if (handed_over_) watch_handing_over(now);
    tell_following(now);
    tell_mode();
    if (view_ && !viewers_ && !is_leaving_ && !is_drained_ && is_owner_gone(now)) {
      if (take_over()) return true;
      view_.reset();  // what came meanwhile was not kept
      tried_ = Clock::now();
    }
  }
  return false;
}

bool Node::begin_following() {
  begin_at_ = Clock::now() + kBeginEvery;
  view_.emplace(fresh_view());
  passed_over_ = 0;
  going_.reset();
  has_lost_rooms_ = false;
  after_ = 0;
  const auto state = log_link_->stream_state();
  if (!state) return complain(state.error());
  after_ = state->last;
  // A stream whose batches have all gone by age holds nothing.
  is_log_empty_ = state->messages == 0;
  if (is_log_empty_) return true;
  if (const auto read = read_beginning(*state); !read) return complain(read.error());
  came_at_ = Clock::now();
  show();
  last_fault_.clear();
  return true;
}

/// Nothing comes of a log that was made anew: what it holds is not what was read.
bool Node::has_log_gone_back(Time now) {
  constexpr Duration kAfter = std::chrono::seconds(2);
  if (now - std::max(came_at_, looked_back_at_) < kAfter || is_cut_off()) return false;
  looked_back_at_ = now;
  const auto state = log_link_->stream_state();
  if (!state || state->last >= view_->sequence()) return false;
  return !complain(
      {"the log", joined({"ends at batch ", std::to_string(state->last), ", before ",
                          std::to_string(view_->sequence()), ", which was read: it is another one"})});
}

ShardView Node::fresh_view() {
  if (!viewers_) return {};
  to_show_.clear();
  ShardView::Reader reader;
  reader.line = [this](const std::string& room, std::string_view line) {
    if (to_show_.empty() || to_show_.back().first != room)
      to_show_.emplace_back(room, std::vector<std::string>());
    to_show_.back().second.emplace_back(line);
  };
  reader.closed = [this](const std::string& room) {
    show();
    shown_.erase(room);
    viewers_->closed(room);
  };
  return ShardView(std::move(reader));
}

/// What has been read is handed on.
void Node::show() {
  for (auto& [room, lines] : std::exchange(to_show_, {})) {
    shown_.insert(room);
    viewers_->lines(room, std::move(lines));
  }
}

/// Lines of the batch that begins there.
core::Expected<std::string> Node::read_whole(std::uint64_t sequence) {
  WholeBatches whole;
  for (std::uint32_t part = 0; part < kMostParts; ++part) {
    const std::string place = joined({"batch ", std::to_string(sequence + part)});
    const auto message = log_link_->read(sequence + part);
    if (!message) return tl::unexpected(message.error());
    const auto batch = unpack(message->bytes, place);
    if (!batch) return tl::unexpected(batch.error());
    if (const auto lines = whole.take(*batch)) return std::string(*lines);
    if (batch->head.part != part) break;
  }
  return core::fail(joined({"batch ", std::to_string(sequence)}), "is not whole");
}

/// From the last batch that is one, which says where to begin; what is none behind it is passed over.
core::Expected<void> Node::read_beginning(const NatsLink::StreamState& state) {
  std::uint64_t at = state.last;
  core::Expected<Batch> batch = core::fail("the log", "holds no batch");
  for (std::uint64_t tries = 0; tries < kMostPassedOver && at >= state.first; ++tries, --at) {
    const auto message = log_link_->read(at);
    if (!message) return tl::unexpected(message.error());
    batch = unpack(message->bytes, joined({"batch ", std::to_string(at)}));
    if (batch) break;
    complain(batch.error());
  }
  if (!batch) return tl::unexpected(batch.error());
  // What has gone by age can't be read: all hosts were away for long.
  BatchHead head = batch->head;
  std::erase_if(head.rooms, [&](const RoomPlace& room) {
    const bool is_lost = room.header < state.first || room.keyframe < state.first;
    if (is_lost) complain({"ROOM LOST", joined({room.room, ": the log holds its beginning no more"})});
    has_lost_rooms_ = has_lost_rooms_ || is_lost;
    return is_lost;
  });
  std::erase_if(shown_, [&](const std::string& room) {
    const bool is_there = std::any_of(head.rooms.begin(), head.rooms.end(),
                                      [&room](const RoomPlace& place) { return place.room == room; });
    if (!is_there) viewers_->closed(room);
    return !is_there;
  });
  const auto beginning = ShardView::beginning({at, head});
  for (const auto& [sequence, rooms] : beginning.headers) {
    const auto lines = read_whole(sequence);
    if (!lines) return tl::unexpected(lines.error());
    const std::string place = joined({"batch ", std::to_string(sequence)});
    if (auto taken = view_->take_headers(rooms, *lines, place); !taken) return taken;
  }
  say(LogEvent::kClusterFollows,
      joined({"follows the log of ", settings_.shard, ", which is that of ", to_text(batch->head.writer),
              ", from batch ", std::to_string(beginning.from), " on"}));
  return log_link_->follow(beginning.from, [inbox = inbox_, reading = ++reading_](
                                               const auto&, std::string bytes, std::uint64_t sequence) {
    inbox->put(LogMessage{sequence, std::move(bytes), reading});
  });
}

/// False: something is missing, or what was read is worth nothing any more: it is begun anew. What is no
/// batch, or is nobody's who may write, is passed over.
bool Node::take_message(const LogMessage& message) {
  if (message.reading != reading_ || message.sequence <= view_->sequence()) return true;
  if (view_->sequence() != 0 && message.sequence - view_->sequence() > kMostPassedOver)
    return complain({"the log", joined({"batch ", std::to_string(view_->sequence() + 1), " did not come"})});
  while (view_->sequence() != 0 && message.sequence != view_->sequence() + 1)
    if (!pass_gap()) return false;
  const auto batch = unpack(message.bytes, joined({"batch ", std::to_string(message.sequence)}));
  const auto order = batch ? view_->check_order(message.sequence, batch->head)
                           : core::Expected<void>(tl::unexpected(batch.error()));
  if (!order) {
    complain(order.error());
    if (view_->sequence() != 0) view_->pass_over(message.sequence);
    return ++passed_over_ < kMostPassedOver;  // or it is another log than was read
  }
  passed_over_ = 0;
  if (const auto taken = view_->take(message.sequence, *batch); !taken) return complain(taken.error());
  heard_ = came_at_ = Clock::now();
  show();
  if (!view_->difference().empty() && !std::exchange(has_differed_, true))
    say(LogEvent::kClusterDiffers,
        joined({"FOLLOWER DIFFERS: ", view_->difference(), "; this host takes nothing of it over"}));
  return true;
}

/// Over the next batch, which did not come. False: it is there, and to be read again.
bool Node::pass_gap() {
  const std::uint64_t next = view_->sequence() + 1;
  const auto missing = log_link_->read(next);
  if (!missing || !missing->bytes.empty())
    return complain({"the log", joined({"batch ", std::to_string(next), " did not come"})});
  complain({joined({"batch ", std::to_string(next)}), "is gone from the log"});
  view_->lose(next);
  return true;
}

/// Once of each fault in a row. False.
bool Node::complain(const core::Error& error) {
  const std::string text = error.text();
  if (text != std::exchange(last_fault_, text)) say(LogEvent::kClusterFault, text);
  return false;
}

void Node::tell_line() {
  const bool is_cut = is_cut_off();
  if (std::exchange(was_cut_off_, is_cut) == is_cut) return;
  if (is_cut)
    say(LogEvent::kClusterFault, "NATS is not connected");
  else
    say(LogEvent::kClusterFollows, "NATS is connected again");
}

void Node::tell_following(Time now) {
  const bool is_ready = !is_drained_ && view_ && view_->head() && !has_differed_ && !has_lost_rooms_ &&
                        !view_->has_gap() && !view_->lacks_rooms() && !is_cut_off() &&
                        (!viewers_ || !shown_.empty());
  told_.follow(is_ready, has_differed_, view_ ? view_->sequence() : 0);
  heartbeat_.tell([&](Beat& beat) {
    beat.owns = false;
    beat.leaves = is_leaving_ || is_drained_;
    beat.ready = is_ready;
    beat.silent_ms = static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(view_ ? silence(now) : Duration{}).count());
    if (!view_) return;
    beat.writer = view_->head() ? view_->head()->writer : Writer{};
    beat.sequence = view_->sequence();
  });
  if (!view_) return;
  std::vector<std::string> rooms;
  for (const auto& [name, room] : view_->rooms()) rooms.push_back(name);
  // An owner opens its rooms one after the other.
  constexpr Duration kComplete = std::chrono::seconds(2);
  const std::lock_guard lock(mutex_);
  if (rooms != known_rooms_) rooms_changed_ = now;
  known_rooms_ = std::move(rooms);
  if (viewers_ || !is_ready || !rooms_changed_ || now - *rooms_changed_ < kComplete) return;
  rooms_changed_.reset();
  hooks_.stands_by(known_rooms_);
}

/// Of two modes of the hosts of a shard the owner's holds; another one's from the next takeover on.
void Node::tell_mode() {
  if (viewers_ || !view_ || !view_->head()) return;
  const auto is_strict = table().is_strict(view_->head()->writer);
  const bool differs = is_strict && *is_strict != settings_.is_strict;
  if (differs && !is_other_mode_told_)
    say(LogEvent::kClusterFault,
        joined({view_->head()->writer.host, " plays in mode ", *is_strict ? "strict" : "play",
                ", this host in mode ", settings_.is_strict ? "strict" : "play",
                ": \"mode\" is to be the same in the file of each"}));
  if (is_strict) is_other_mode_told_ = differs;
}

/// Until another host has them, or none does; then who is here is sent on.
void Node::watch_handing_over(Time now) {
  // It says so itself, and sooner than this one has read it in the log.
  const auto owner = table().owner(now);
  const bool is_taken = owner && owner->writer.epoch > handed_epoch_;
  if (!is_taken && now - *handed_over_ < kTakenWithin) return;
  if (!is_taken) is_drained_ = false;  // or they would be nobody's
  if (!inbox_->is_stopping()) hooks_.step_down(is_taken ? owner->address : settings_.address);
  handed_over_.reset();
  is_leaving_ = false;
  heartbeat_.tell([](Beat& beat) { beat.to.clear(); });
}

Duration Node::silence(Time now) const {
  const Time heard = view_->head() ? std::max(heard_, table().heard(view_->head()->writer)) : heard_;
  return std::max(Duration{}, now - heard);
}

/// Those who stand by try one after the other; the log decides in any case.
bool Node::is_owner_gone(Time now) {
  constexpr Duration kTurn = std::chrono::milliseconds(100);
  constexpr Duration kUnlessHeard = std::chrono::milliseconds(250);
  constexpr Duration kUnlessOthersCan = std::chrono::seconds(2);
  if (has_differed_) return false;  // though it might go on from a later keyframe: which of the two errs?
  if (is_cut_off() || table().has_twin(now)) {
    if (table().has_twin(now))
      complain({"the cluster", "another host has this one's name: give each its own by --cluster-host"});
    return false;
  }
  const auto place = table().place_in_line(settings_.silence, now);
  const Duration turn =
      kTurn * static_cast<int>(place.value_or(0)) +
      (has_lost_rooms_ || view_->has_gap() || view_->lacks_rooms() || !view_->head() ? kUnlessOthersCan
                                                                                     : Duration{});
  if (tried_ != Time{} && now - tried_ < settings_.silence) return false;
  // A new log is nobody's; one that was emptied may be that of a host which lives.
  if (!view_->head() || view_->head()->writer.epoch == 0)
    return !table().owner(now) && (view_->head() || after_ != 0) &&
           silence(now) >
               (view_->head() ? std::min<Duration>(settings_.silence, kUnlessHeard) : settings_.silence) +
                   turn;
  constexpr Duration kUnlessWanted = std::chrono::seconds(1);
  if (const auto to = table().leaves(view_->head()->writer)) {
    const bool is_wanted = *to == settings_.host;
    const Duration wait = is_wanted ? Duration{} : turn + (to->empty() ? Duration{} : kUnlessWanted);
    return now - *(going_ = going_.value_or(now)) >= wait;
  }
  return place && silence(now) > settings_.silence + turn;
}

}  // namespace woodlouse::server
