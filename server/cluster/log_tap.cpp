#include "server/cluster/log_tap.h"

#include <atomic>
#include <cassert>
#include <utility>

#include "shared/replay/writer.h"

namespace woodlouse::server {
namespace {

TapNumber next_number() {
  static std::atomic<TapNumber> last{0};
  return ++last;
}

}  // namespace

LogTap::LogTap(std::shared_ptr<LogDesk> desk, std::string room, replay::Header header, Duration away,
               bool is_strict)
    : desk_(std::move(desk)),
      number_(next_number()),
      room_(std::move(room)),
      header_(std::move(header)),
      keyframe_ticks_(replay::keyframe_ticks(header_.tick_hz)),
      away_(away),
      is_strict_(is_strict) {
  assert(desk_ != nullptr && !room_.empty());
}

/// Where it is refused, what follows up to the next keyframe is worth nothing.
bool LogTap::post(LogDesk::Job job) {
  const bool is_taken = desk_->post(std::move(job));
  has_lost_ = has_lost_ || !is_taken;
  return is_taken;
}

void LogTap::begin(const match::Match& game) { tell_begin(game); }

void LogTap::tell_begin(const match::Match& game) {
  assert(!has_begun_);
  beginnings_ = desk_->beginnings();
  has_lost_ = false;
  has_begun_ =
      post([number = number_, room = room_, header = header_, state = game.state(), announce = announce_](
               ShardText& text, Time now) { text.begin(number, room, header, state, announce, now); });
}

/// One that is lost is told by no keyframe: its player alone is the poorer.
void LogTap::claimed(const Claim& claim) {
  static_cast<void>(post([number = number_, claim](ShardText& text, Time) { text.claim(number, claim); }));
}

void LogTap::chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
                  const std::string& text) {
  if (has_lost_) return;
  static_cast<void>(post([number = number_, tick, player, name, said = text](ShardText& lines, Time) {
    lines.chat(number, tick, player, name, said);
  }));
}

void LogTap::step(const LiveStep& step, const match::Match& game) {
  const Time now = Clock::now();
  if (stepped_at_ != Time::max() && now - stepped_at_ > away_) desk_->doubt();
  stepped_at_ = now;
  const bool is_told_anew = std::exchange(beginnings_, desk_->beginnings()) != desk_->beginnings();
  if (!has_lost_ && !is_told_anew)
    static_cast<void>(
        post([number = number_, step = step.shared()](ShardText& text, Time) { text.step(number, *step); }));
  if (game.tick() % keyframe_ticks_ != 0 && !is_told_anew) return;
  if (!has_begun_) return tell_begin(game);
  const bool is_anew = std::exchange(has_lost_, false) || is_told_anew;
  static_cast<void>(post([number = number_, state = game.state(), is_anew](ShardText& text, Time at) {
    text.keyframe(number, state, is_anew, at);
  }));
}

/// Lines that were refused are in no batch: the game goes on to its next keyframe without them.
bool LogTap::await_kept(const std::function<void()>& kept) {
  if (!is_strict_ || has_lost_) return false;
  desk_->post_soon([number = number_, kept](ShardText& text, Time) { text.await_kept(number, kept); });
  return true;
}

/// What is kept was this host's: it counts from now for how long it was away.
bool LogTap::may_show() {
  if (is_strict_ && stepped_at_ != Time::max()) stepped_at_ = Clock::now();
  return !desk_->is_in_doubt();
}

void LogTap::fall_asleep(const match::Match& game) {
  static_cast<void>(
      post([number = number_, state = game.state()](ShardText& text, Time) { text.rest(number, state); }));
}

void LogTap::finish(const std::string&, std::function<void()> done) {
  static_cast<void>(post([number = number_](ShardText& text, Time) { text.close(number); }));
  done();
}

}  // namespace woodlouse::server
