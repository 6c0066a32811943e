#include "shared/follow/follower.h"

#include <cassert>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "shared/core/joined.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/source.h"
#include "shared/replay/step_line.h"

namespace woodlouse::follow {

using core::joined;

bool Follower::take(std::string_view line) {
  assert(line.find('\n') == std::string_view::npos);
  if (difference_) return false;
  ++lines_;
  const auto taken = [&]() -> core::Expected<void> {
    if (auto step = replay::scan_step(line)) return follow(std::move(*step));
    if (line.starts_with(R"({"format":)")) return begin(line);
    replay::BytesStream one(std::make_shared<const std::string>(std::string(line) + '\n'));
    replay::ReplayReader reader(one, source_, lines_ - 1);
    auto read = reader.next_line();
    if (!read) return tl::unexpected(read.error());
    assert(*read);
    return follow(std::move(**read));
  }();
  if (!taken) differ(match() != nullptr ? match()->tick() : 0, taken.error().text());
  return !difference_;
}

void Follower::begin_anew() {
  rerun_.reset();
  map_.reset();
  settings_.reset();
}

/// The step's own tick is the one that it leads from.
void Follower::differ(std::uint64_t tick, std::string what) {
  difference_ = replay::Difference{tick, std::move(what), {}};
  rerun_.reset();
}

core::Expected<void> Follower::begin(std::string_view line) {
  begin_anew();
  replay::BytesStream one(std::make_shared<const std::string>(std::string(line) + '\n'));
  replay::ReplayReader reader(one, source_, lines_ - 1);
  const auto header = reader.read_header();
  if (!header) return tl::unexpected(header.error());
  auto map = replay::recorded_map(*header, {source_, nullptr, nullptr}, maps_);
  if (!map) return tl::unexpected(map.error());
  map_ = std::move(*map);
  settings_ = replay::settings_of(*header);
  return {};
}

core::Expected<void> Follower::follow(replay::Line line) {
  if (auto* step = std::get_if<replay::StepLine>(&line)) return this->step(std::move(*step));
  if (auto* keyframe = std::get_if<replay::Keyframe>(&line)) return go_on(std::move(*keyframe));
  if (const auto* chat = std::get_if<replay::ChatLine>(&line); chat != nullptr && witness_ != nullptr)
    witness_->said(*chat);
  return {};  // for who reads
}

core::Expected<void> Follower::go_on(replay::Keyframe keyframe) {
  if (!map_) return core::fail(source_, "a keyframe stands before any header");
  const std::uint64_t tick = keyframe.state.tick;
  if (rerun_ && tick == match()->tick() && keyframe.state.hash != match()->hash()) {
    differ(tick, joined({"keyframe ", std::to_string(tick), ": its hash is ",
                         core::to_hex(keyframe.state.hash), ", re-run ", core::to_hex(match()->hash())}));
    return {};
  }
  gaps_ += rerun_ && tick != match()->tick() ? 1 : 0;
  const auto former = std::move(rerun_);
  auto rerun = replay::Rerun::from_recorded(map_, *settings_, std::move(keyframe), source_);
  if (!rerun) {
    differ(tick, rerun.error().text());
    return {};
  }
  rerun_ = std::move(*rerun);
  if (witness_ != nullptr) witness_->began(*match());
  return {};
}

core::Expected<void> Follower::step(replay::StepLine line) {
  if (!rerun_) return core::fail(source_, "a step stands before any keyframe");
  const std::uint64_t still = witness_ == nullptr && line.steps > 1 && line.step.hash == match()->hash() &&
                                      line.step.tick == match()->tick()
                                  ? rerun_->stand_still(line.steps)
                                  : 0;
  proven_ += still;
  line.step.tick += still;
  for (std::uint64_t k = still; k < line.steps; ++k, ++line.step.tick) {
    auto difference = rerun_->step(line, source_);
    if (!difference) return tl::unexpected(difference.error());
    if (*difference) {
      differ((*difference)->tick, std::move((*difference)->what));
      return {};
    }
    ++proven_;
    if (witness_ != nullptr) witness_->stepped(rerun_->last(), *match());
  }
  return {};
}

}  // namespace woodlouse::follow
