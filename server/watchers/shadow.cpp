#include "server/watchers/shadow.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <utility>

#include "server/logging/events.h"
#include "shared/core/joined.h"
#include "shared/core/sink_file.h"
#include "shared/replay/writer.h"

namespace woodlouse::server {

using core::joined;

Shadow::Shadow(std::string room, std::shared_ptr<const map::Map> map, replay::Header header,
               std::filesystem::path dump, boost::asio::thread_pool& pool,
               std::shared_ptr<spdlog::logger> log)
    : room_(std::move(room)),
      map_(std::move(map)),
      dump_(std::move(dump)),
      strand_(boost::asio::make_strand(pool.get_executor())),
      log_(std::move(log)),
      header_(std::move(header)) {}

void Shadow::begin(const match::Match& game) {
  // Only values go along: the game itself goes on meanwhile.
  boost::asio::post(strand_, [this, state = game.state()]() mutable {
    if (const auto followed = follow(std::move(state)); !followed) end(followed.error().text());
  });
}

core::Expected<void> Shadow::follow(match::MatchState game) {
  auto rerun = replay::Rerun::from(map_, replay::settings_of(header_), {game}, "the game's state");
  if (!rerun) return tl::unexpected(rerun.error());
  rerun_ = std::move(*rerun);
  before_ = std::move(game);
  return {};
}

void Shadow::step(const LiveStep& step, const match::Match& game) {
  if (ended_) return;
  if (queued_ >= kMaxQueued) return end(joined({"it fell ", std::to_string(kMaxQueued), " steps behind"}));
  ++queued_;
  boost::asio::post(strand_, [this, record = step.record(), state = game.state()]() mutable {
    if (!ended_ && Clock::now() < finish_by_.load()) compare(record, std::move(state));
    --queued_;
  });
}

void Shadow::compare(const match::StepRecord& record, match::MatchState game) {
  replay::StepLine line;
  line.step = record;
  const auto difference = rerun_->step(line, "the game's step");
  if (!difference) return end(difference.error().text());
  ++ticks_;
  if (!*difference) {
    before_ = std::move(game);
    return;
  }
  if (++differences_ == 1) tell(record, game, (*difference)->what);
  // From the game's state on, so that the next difference is one of its own.
  if (const auto followed = follow(std::move(game)); !followed) end(followed.error().text());
}

void Shadow::tell(const match::StepRecord& record, const match::MatchState& game, const std::string& what) {
  const match::MatchState shadow = rerun_->match().state();
  const std::string detail = rerun_->difference_to({game});
  match::StepRecord own = record;
  own.hash = shadow.hash;
  const auto kept = [](const core::Expected<std::string>& file) {
    return file ? *file : file.error().text();
  };
  const std::string game_file = kept(dump_side("game", record, game));
  const std::string shadow_file = kept(dump_side("shadow", own, shadow));
  log_event(
      *log_, LogEvent::kShadowDiffers,
      fmt::format(
          "SHADOW DIFFERS: room {}: tick {}: {}; {}. The game's is what is called recorded, its shadow's the "
          "re-run. Both "
          "are kept: {} and {}; ask woodlouse-server verify which of them this machine gives again. The game "
          "goes on; "
          "further differences are only counted",
          room_, game.tick, what, detail.empty() ? "the states are the same" : detail, game_file,
          shadow_file));
}

/// A recording of that one step: the state before it, on which both agreed, and the one after.
core::Expected<std::string> Shadow::dump_side(const char* side, const match::StepRecord& record,
                                              const match::MatchState& after) const {
  std::string bytes;
  replay::ReplayWriter writer;
  writer.append_header(bytes, header_);
  writer.append_keyframe(bytes, before_);
  writer.append_step(bytes, record);
  writer.append_keyframe(bytes, after);
  writer.append_end(bytes, "the shadow differs");
  const std::string file = joined({dump_.string(), ".", std::to_string(after.tick), ".", side, ".ndjson"});
  const auto out = core::create_file(file);
  auto written = out ? out->sink->write(bytes) : core::Expected<void>(tl::unexpected(out.error()));
  if (written) written = out->sink->close();
  if (!written) return core::fail(file, joined({"can't be written: ", written.error().what}));
  return out->path.string();
}

void Shadow::finish(const std::string&, std::function<void()> done) {
  finish_by_ = Clock::now() + kFinishWithin;
  boost::asio::post(strand_, std::move(done));
}

void Shadow::add_figures(RoomFigures& figures) const {
  ShadowFigures& all = figures.shadow ? *figures.shadow : figures.shadow.emplace();
  all.ticks += ticks_;
  all.differences += differences_;
  all.ended |= ended_;
}

void Shadow::end(const std::string& why) {
  if (ended_.exchange(true)) return;
  log_event(*log_, LogEvent::kShadowEnded,
            fmt::format("SHADOW ENDED: room {}: {}; the game goes on, its ticks are no longer compared",
                        room_, why));
}

}  // namespace woodlouse::server
