#include "server/cluster/node.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

#include "server/access/resume_token.h"
#include "shared/core/joined.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {

using core::joined;

void Node::own() {
  assert(writer_ && text_);
  while (!inbox_->is_stopping() && !is_to_hand_over_) {
    hear(inbox_->take(next_look(Clock::now())));
    if (renew_log_link()) writer_->failed();
    if (inbox_->is_in_doubt()) ask_the_log();
    const Time now = Clock::now();
    text_->renew(now, kCutBytes);
    // One batch is on its way at a time: what is cut beside it would only wait in more pieces.
    const bool is_free = writer_->waiting() == 0;
    const bool is_due = now >= cut_at_ || (is_free && text_->is_awaited());
    if ((is_due && (is_free || is_full_)) || text_->size() >= cut_bytes()) cut(now);
    write(now);
    tell_kept();
    // Its own former epoch is no other host's: what said that it was gone was an old read.
    const bool is_gone =
        writer_->state() == LogWriter::State::kGone || (!writer_->is_open() && writer_->other() == former_);
    if (is_gone ? !begin_log_anew() : !writer_->is_open()) return step_down();
    if (!writer_->is_open()) continue;
    tell_owning();
    watch_durability(now);
  }
  store_the_rest();
  if (is_to_hand_over_.exchange(false)) {
    handed_over_ = Clock::now();
    handed_epoch_ = writer_->writer().epoch;
  }
  writer_.reset();
}

/// What NATS answers and what is awaited wakes this thread; a batch has its time.
Time Node::next_look(Time now) const {
  const Time unasked = now + std::min(LogWriter::kAskEvery, settings_.batch);
  return cut_at_ > now ? std::min(cut_at_, unasked) : unasked;
}

/// Who was away asks before anything is shown. Where nobody answers, the rooms go on after a while, as they
/// do while nothing is stored.
void Node::ask_the_log() {
  if (doubted_at_ == Time{}) doubted_at_ = Clock::now();
  const auto last = read_last();
  if (last || (!settings_.is_strict && Clock::now() - doubted_at_ > kNotDurableAfter)) doubted_at_ = Time{};
  if (!last) return doubted_at_ == Time{} ? inbox_->settle() : void();  // or it is asked again
  if (last->head.writer == writer_->writer()) return inbox_->settle();
  writer_->failed();  // which has it read, and judged
}

void Node::tell_owning() {
  told_.own(*writer_, Clock::now());
  heartbeat_.tell([this](Beat& beat) {
    beat.owns = true;
    beat.writer = writer_->writer();
    beat.sequence = writer_->next_sequence() - 1 - writer_->waiting();
    beat.silent_ms = 0;
    beat.ready = false;
  });
  const std::lock_guard lock(mutex_);
  known_rooms_.clear();
  for (const RoomPlace& place : text_->places()) known_rooms_.push_back(place.room);
}

void Node::hear(std::deque<NodeEvent> events) {
  const Time now = Clock::now();
  if (is_leaving_) text_->keep_rooms();
  for (NodeEvent& event : events) {
    if (const auto* job = std::get_if<LogDesk::Job>(&event)) {
      (*job)(*text_, now);
      if (text_->size() >= cut_bytes() && writer_->is_open()) cut(now);  // many rooms begin at once
    }
    if (const auto* stored = std::get_if<Acknowledged>(&event)) writer_->acknowledged(stored->sequence, now);
    if (const auto* no = std::get_if<Refused>(&event)) {
      // That another batch stands there is told once it is known whose.
      if (no->why.find("wrong last sequence") == std::string::npos) complain({"the log", no->why});
      writer_->failed();
    }
  }
}

/// What there is to tell; the first batch of an epoch tells nothing, and an idle log is kept alive.
void Node::cut(Time now) {
  text_->flush();
  const bool has_room = writer_->waiting() < kMostWaiting && writer_->bytes() <= LogWriter::kMostBytes;
  // Before anything else: of what was dropped the rooms tell nothing more until they are asked to.
  if (has_room && std::exchange(is_full_, false)) inbox_->begin_anew();
  const bool is_first = writer_->next_number() == 0;
  const bool is_late = now - cut_at_ > settings_.keep / 3;
  if (text_->size() == 0 && !is_first && !is_late) {  // they wait for the batch before
    if (text_->is_awaited()) kept_.emplace_back(writer_->next_number(), text_->take_awaiting());
    return;
  }
  if (!has_room) {
    if (!is_full_ && text_->size() < kCutBytes) return;  // some may be taken yet
    text_->lose();
    if (!std::exchange(is_full_, true))
      say(LogEvent::kClusterHole,
          "LOG HAS A HOLE: nothing is stored; its rooms are told anew, once something is");
    return;
  }
  std::vector<RoomPlace> before = text_->places();
  std::erase_if(before, [](const RoomPlace& place) { return place.header == 0; });
  const std::string lines = text_->cut(writer_->next_sequence());
  std::vector<std::string> parts = pack_in_parts(
      {writer_->writer(), writer_->next_number(), match::kBehavior, text_->places()}, before, lines);
  cut_at_ = now + settings_.batch;
  if (parts.empty()) {
    text_->lose();
    inbox_->begin_anew();
    return say(LogEvent::kClusterHole,
               "LOG HAS A HOLE: a batch is longer than it may be; its rooms are told anew");
  }
  for (std::string& part : parts) writer_->add(std::move(part));
  if (auto awaiting = text_->take_awaiting(); !awaiting.empty())
    kept_.emplace_back(writer_->next_number(), std::move(awaiting));
}

/// Whose step is stored may be shown it.
void Node::tell_kept() {
  while (!kept_.empty() && kept_.front().first <= writer_->acked()) {
    for (const auto& kept : kept_.front().second) kept();
    kept_.pop_front();
  }
}

void Node::write(Time now) {
  if (writer_->is_to_ask(now)) {
    const auto last = read_last();
    writer_->read(last, Clock::now());
  }
  while (const auto publish = writer_->next(now)) {
    const auto sent = log_link_->append(*publish->bytes, publish->after);
    if (sent) continue;
    complain(sent.error());
    return writer_->failed();
  }
}

std::optional<LastBatch> Node::read_last() {
  const auto last = log_link_->last();
  if (!last) {
    complain(last.error());
    return std::nullopt;
  }
  const auto batch = unpack(last->bytes, joined({"batch ", std::to_string(last->sequence)}));
  if (batch) return LastBatch{last->sequence, batch->head};
  complain(batch.error());
  return LastBatch{last->sequence, {}};  // nobody's: a new epoch goes on behind it
}

/// The stream has less than was stored, and more is missing than this host has kept: a new epoch goes on from
/// what there is, and its rooms are told anew with their next steps. False: it is another host's.
bool Node::begin_log_anew() {
  const auto last = read_last();
  if (!last) return true;  // and is read again
  const Writer former = writer_->writer();
  const bool is_own = last->head.writer == former || last->head.writer == former_;
  if (last->head.writer.epoch >= former.epoch && !is_own) return false;
  former_ = former;
  say(LogEvent::kClusterHole,
      joined({"LOG HAS A HOLE: its last batch is ", std::to_string(last->sequence), ", of ",
              to_text(last->head.writer), ", less than was stored; its rooms are told anew"}));
  for (const auto& [number, waiting] : std::exchange(kept_, {}))
    for (const auto& kept : waiting) kept();  // told anew with what follows
  writer_.emplace(
      Writer{std::max(former.epoch, last->head.writer.epoch) + 1, settings_.host, make_resume_token()},
      last->sequence);
  text_->lose();
  inbox_->begin_anew();
  text_->forget_places();
  cut(Clock::now());
  return true;
}

void Node::watch_durability(Time now) {
  const bool is_strict = settings_.is_strict;
  const bool is_soon = is_strict || is_cut_off();
  const bool is_late = writer_->silence(now) > (is_soon ? settings_.silence : kNotDurableAfter);
  if (is_late == is_told_not_durable_) return;
  is_told_not_durable_ = is_late;
  if (is_late)
    say(LogEvent::kClusterNotDurable,
        joined({"NOT DURABLE: nothing is stored; the rooms ", is_strict ? "stand still" : "go on"}));
  else
    say(LogEvent::kClusterDurable, "what is played is stored again");
  if (is_strict)
    text_->announce(is_late ? protocol::Notice{std::string(protocol::code::kPaused),
                                               "the game waits: nothing that is played can be stored"}
                            : protocol::Notice{std::string(protocol::code::kResumed), "the game goes on"},
                    is_late);
  else
    text_->announce(
        {std::string(is_late ? protocol::code::kNotDurable : protocol::code::kDurable),
         is_late ? "what is played now would be lost with this server" : "what is played is safe again"},
        is_late);
}

void Node::step_down() {
  const auto owner = table().owner(Clock::now());
  say(LogEvent::kClusterFenced,
      joined({"FENCED: the log is that of ", to_text(writer_->other()),
              owner ? " at " + owner->address : std::string(), "; the rooms end here"}));
  heartbeat_.tell([](Beat& beat) { beat.owns = false; });
  kept_.clear();  // nobody is shown what another host's log has not
  hooks_.step_down(owner ? owner->address : std::string());
  writer_.reset();
}

/// All that was told, as far as that goes soon; then whoever stands by hears that this host goes.
void Node::store_the_rest() {
  const Time until = Clock::now() + kLeaveWithin;
  hear(inbox_->take(Clock::now()));
  cut(Clock::now());
  while (writer_->is_open() && writer_->waiting() > 0 && Clock::now() < until) {
    write(Clock::now());
    const Time next = Clock::now() + kLook;
    hear(inbox_->take(next));
    if (inbox_->is_stopping()) std::this_thread::sleep_until(next);  // its inbox waits for nothing
  }
  tell_kept();
  kept_.clear();
  tell_owning();
  heartbeat_.tell([](Beat& beat) { beat.leaves = true; });
  heartbeat_.soon();
}

}  // namespace woodlouse::server
