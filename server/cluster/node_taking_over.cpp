// How a host becomes the owner of its shard: it reads to the log's end, and writes behind it.
#include <cassert>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "server/access/resume_token.h"
#include "server/cluster/node.h"
#include "shared/core/joined.h"

namespace woodlouse::server {

using core::joined;

bool Node::take_over() {
  const auto writer_of_last = [this] { return view_->head() ? view_->head()->writer : Writer{}; };
  const Writer gone = writer_of_last();
  if (!view_->difference().empty() || !catch_up()) return false;
  if (writer_of_last() != gone) {  // who has it now may well be there
    say(LogEvent::kClusterFollows, joined({"another host was first: ", to_text(writer_of_last())}));
    return false;
  }
  if (!take_log()) return false;
  std::vector<RoomToGoOn> rooms = rooms_to_go_on();
  say(LogEvent::kClusterOwns,
      joined({"owns ", settings_.shard, " as ", to_text(writer_->writer()), " from batch ",
              std::to_string(writer_->next_sequence() - 1), " on; ", std::to_string(rooms.size()),
              rooms.size() == 1 ? " room goes on" : " rooms go on",
              settings_.is_strict ? "; mode strict" : ""}));
  std::set<std::string> names;
  for (const RoomToGoOn& room : rooms) names.insert(room.name);
  text_->keep_places(names);
  inbox_->settle();
  tell_owning();
  heartbeat_.soon();
  if (!inbox_->is_stopping() && !is_leaving_) hooks_.take_over(std::move(rooms));
  log_link_->unfollow();  // which asks NATS: whoever plays does not wait for its answer
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
    if (message->bytes.empty() ? !pass_gap() : !take_message({message->sequence, message->bytes, reading_}))
      return false;
  }
  return view_->difference().empty();
}

/// By the first batch of an epoch.
bool Node::take_log() {
  constexpr Duration kWait = std::chrono::seconds(5);
  const std::uint64_t known = view_->head() ? view_->head()->writer.epoch : 0;
  writer_.emplace(Writer{std::max(known, table().highest_epoch()) + 1, settings_.host, make_resume_token()},
                  view_->head() ? view_->sequence() : after_);
  text_.emplace(settings_.keep);
  is_full_ = false;
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
  else
    complain({"the log", "did not take this host's first batch"});
  writer_.reset();
  return false;
}

std::vector<RoomToGoOn> Node::rooms_to_go_on() {
  std::vector<RoomToGoOn> rooms;
  for (const RoomPlace& place : view_->head() ? view_->head()->rooms : std::vector<RoomPlace>())
    if (!view_->rooms().contains(place.room))
      say(LogEvent::kClusterHole,
          joined({"ROOM LOST: ", place.room, ": the log holds its beginning no more"}));
  for (const auto& [name, room] : view_->rooms()) {
    const match::Match* match = room.follower->match();
    if (match == nullptr) {
      say(LogEvent::kClusterHole,
          joined({"ROOM LOST: ", name, ": the log holds no keyframe of it any more"}));
      continue;
    }
    if (room.stands_still)
      say(LogEvent::kClusterHole, joined({"LOG HAS A HOLE: room ", name, " goes on at tick ",
                                          std::to_string(match->tick()), ", before a batch that is gone"}));
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
