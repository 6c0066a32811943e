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

/// True: the log is this host's. False: the node ends.
bool Node::follow() {
  view_.reset();
  is_difference_told_ = false;
  heard_ = Clock::now();
  Time looked = heard_;
  while (!inbox_->is_stopping()) {
    if (!view_ && !begin_following()) view_.reset();
    for (NodeEvent& event : inbox_->take(Clock::now() + 4 * kLook)) {
      const auto* message = std::get_if<LogMessage>(&event);
      if (message != nullptr && view_ && !take_message(*message)) view_.reset();
    }
    const Time now = Clock::now();
    // Who was away himself has heard nobody.
    if (now - std::exchange(looked, now) > settings_.silence / 2) heard_ = now;
    if (!view_) continue;
    tell_following(now);
    if (is_owner_gone(now) && take_over()) return true;
  }
  return false;
}

bool Node::begin_following() {
  const auto last = log_link_->last();
  view_.emplace();
  after_ = 0;
  if (last) {
    if (const auto read = read_beginning(*last); !read) return complain(read.error());
    last_fault_.clear();
    return true;
  }
  // A stream whose batches have all gone by age is a new one; one that does not answer isn't.
  const auto state = log_link_->stream_state();
  if (!state || state->messages != 0) return complain(last.error());
  after_ = state->last;
  return true;
}

core::Expected<void> Node::read_beginning(const NatsLink::Message& last) {
  const std::string place = joined({"batch ", std::to_string(last.sequence)});
  const auto batch = unpack(last.bytes, place);
  if (!batch) return tl::unexpected(batch.error());
  // What has gone by age can't be read: all hosts were away for long.
  const auto state = log_link_->stream_state();
  if (!state) return tl::unexpected(state.error());
  BatchHead head = batch->head;
  std::erase_if(head.rooms, [&](const RoomPlace& room) {
    const bool is_lost = room.header < state->first || room.keyframe < state->first;
    if (is_lost)
      say(LogEvent::kClusterHole,
          joined({"ROOM LOST: ", room.room, ": the log holds its beginning no more"}));
    return is_lost;
  });
  const auto beginning = ShardView::beginning({last.sequence, head});
  for (const auto& [room, sequence] : beginning.headers) {
    const auto message = log_link_->read(sequence);
    if (!message) return tl::unexpected(message.error());
    const auto headers = unpack(message->bytes, joined({"batch ", std::to_string(sequence)}));
    if (!headers) return tl::unexpected(headers.error());
    if (auto taken = view_->take_header(room, *headers, place); !taken) return taken;
  }
  say(LogEvent::kClusterFollows,
      joined({"follows the log of ", settings_.shard, ", which is that of ", to_text(batch->head.writer),
              ", from batch ", std::to_string(beginning.from), " on"}));
  return log_link_->follow(beginning.from,
                           [inbox = inbox_](const auto&, std::string bytes, std::uint64_t sequence) {
                             inbox->put(LogMessage{sequence, std::move(bytes)});
                           });
}

/// False: what follows can't be understood from here, and is begun anew.
bool Node::take_message(const LogMessage& message) {
  if (message.sequence <= view_->sequence()) return true;
  const auto batch = unpack(message.bytes, joined({"batch ", std::to_string(message.sequence)}));
  if (!batch) return complain(batch.error());
  if (const auto taken = view_->take(message.sequence, *batch); !taken) return complain(taken.error());
  heard_ = Clock::now();
  if (!view_->difference().empty() && !std::exchange(is_difference_told_, true))
    say(LogEvent::kClusterDiffers,
        joined({"FOLLOWER DIFFERS: ", view_->difference(), "; this host takes nothing of it over"}));
  return true;
}

/// Once of each fault in a row. False.
bool Node::complain(const core::Error& error) {
  const std::string text = error.text();
  if (text != std::exchange(last_fault_, text)) say(LogEvent::kClusterFault, text);
  return false;
}

void Node::tell_following(Time now) {
  const std::lock_guard lock(mutex_);
  known_rooms_.clear();
  for (const auto& [name, room] : view_->rooms()) known_rooms_.push_back(name);
  beat_.owns = false;
  beat_.writer = view_->head() ? view_->head()->writer : Writer{};
  beat_.sequence = view_->sequence();
  beat_.silent_ms =
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(silence(now)).count());
}

Duration Node::silence(Time now) const {
  const Time heard = view_->head() ? std::max(heard_, table_.heard(view_->head()->writer)) : heard_;
  return std::max(Duration{}, now - heard);
}

bool Node::is_owner_gone(Time now) const {
  if (!view_->head()) return after_ != 0;
  if (view_->head()->writer.epoch == 0 || table_.leaves(view_->head()->writer)) return true;
  return silence(now) > settings_.silence && table_.may_take_over(settings_.silence, now);
}

// ---- taking over ---------------------------------------------------------------------------------------

bool Node::take_over() {
  if (!view_->difference().empty() || !catch_up() || !take_log()) {
    heard_ = Clock::now();  // and waits as long again
    return false;
  }
  std::vector<RoomToGoOn> rooms = rooms_to_go_on();
  say(LogEvent::kClusterOwns,
      joined({"owns ", settings_.shard, " as ", to_text(writer_->writer()), " from batch ",
              std::to_string(writer_->next_sequence() - 1), " on; ", std::to_string(rooms.size()),
              rooms.size() == 1 ? " room goes on" : " rooms go on"}));
  std::set<std::string> names;
  for (const RoomToGoOn& room : rooms) names.insert(room.name);
  text_->keep_places(names);
  inbox_->settle();
  log_link_->unfollow();
  tell_owning();
  if (!inbox_->is_stopping()) hooks_.take_over(std::move(rooms));
  return true;
}

/// All that is stored is read.
bool Node::catch_up() {
  constexpr Duration kWait = std::chrono::milliseconds(200);
  if (!view_->head()) return true;
  const auto last = log_link_->last();
  if (!last) return complain(last.error());
  const Time until = Clock::now() + kWait;
  while (view_->sequence() < last->sequence && Clock::now() < until)
    for (NodeEvent& event : inbox_->take(Clock::now() + kLook))
      if (const auto* message = std::get_if<LogMessage>(&event);
          message != nullptr && !take_message(*message))
        return false;
  // One by one, where nothing comes by itself.
  while (view_->sequence() < last->sequence) {
    const auto message = log_link_->read(view_->sequence() + 1);
    if (!message) return complain(message.error());
    if (!take_message({message->sequence, message->bytes})) return false;
  }
  return view_->difference().empty();
}

/// By the first batch of an epoch.
bool Node::take_log() {
  constexpr Duration kWait = std::chrono::seconds(5);
  const std::uint64_t epoch = view_->head() ? view_->head()->writer.epoch + 1 : 1;
  writer_.emplace(Writer{epoch, settings_.host, make_resume_token()},
                  view_->head() ? view_->sequence() : after_);
  text_.emplace(settings_.keep);
  if (view_->head()) text_->take_over(view_->head()->rooms);
  cut(Clock::now());
  const Time until = Clock::now() + kWait;
  while (writer_->state() == LogWriter::State::kTaking && Clock::now() < until && !inbox_->is_stopping()) {
    write(Clock::now());
    hear(inbox_->take(Clock::now() + kLook));
  }
  if (writer_->state() == LogWriter::State::kWriting) return true;
  if (writer_->state() == LogWriter::State::kLost)
    say(LogEvent::kClusterFollows, joined({"another host was first: ", to_text(writer_->other())}));
  writer_.reset();
  return false;
}

std::vector<RoomToGoOn> Node::rooms_to_go_on() const {
  std::vector<RoomToGoOn> rooms;
  for (const auto& [name, room] : view_->rooms()) {
    const match::Match* match = room.follower->match();
    if (match == nullptr) {
      say(LogEvent::kClusterHole,
          joined({"ROOM LOST: ", name, ": the log holds no keyframe of it any more"}));
      continue;
    }
    RoomToGoOn& next = rooms.emplace_back();
    next.name = name;
    next.map = match->shared_map();
    next.settings = match->settings();
    next.state = match->state();
    for (const auto& [louse, claim] : room.claims)
      if (match->labels().contains(louse)) next.claims.push_back(claim);
    next.from = joined({"the log of ", settings_.shard});
  }
  return rooms;
}

}  // namespace woodlouse::server
