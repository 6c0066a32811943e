#include "shared/replay/playback.h"
#include "shared/replay/line_reader.h"

#include <algorithm>
#include <utility>

#include "shared/core/joined.h"
#include "shared/replay/archive.h"
#include "shared/replay/rerun.h"

namespace woodlouse::replay {

Playback::Playback(std::shared_ptr<const ReplayArchive> archive) : archive_(std::move(archive)) {}

Playback::~Playback() = default;

const match::Match& Playback::match() const { return rerun_->match(); }

/// Stands at the keyframe afterwards.
core::Expected<void> Playback::restore(std::size_t keyframe) {
  const KeyframePlace& place = archive_->index().keyframes[keyframe];
  const std::string& name = archive_->source().name;
  reader_.reset();  // without it the stream has no place to go on from
  if (!stream_) {
    auto opened = archive_->source().open();
    if (!opened) return tl::unexpected(opened.error());
    stream_ = std::move(*opened);
  }
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(place.offset));
  auto reader = std::make_unique<ReplayReader>(*stream_, name, place.line - 1);
  core::Expected<std::optional<Line>> line = reader->next();
  if (!line) return tl::unexpected(line.error());
  auto* found = *line ? std::get_if<Keyframe>(&**line) : nullptr;
  if (found == nullptr || found->state.tick != place.tick) {
    return core::fail(core::joined({name, ":", std::to_string(place.line)}),
                      core::joined({"the keyframe of tick ", std::to_string(place.tick),
                                    " is not where the index has it"}));
  }
  const Header& header = archive_->header();
  auto rerun = Rerun::from_recorded(archive_->map(), settings_of(header), std::move(*found), reader->place());
  if (!rerun) return tl::unexpected(rerun.error());
  reader_ = std::move(reader);
  rerun_ = std::move(*rerun);
  first_difference_.reset();
  proven_since_ = place.tick;
  return {};
}

/// A keyframe on the way: the index has it, and it shows what the re-run led to.
core::Expected<void> Playback::pass(const Keyframe& keyframe) {
  const std::uint64_t at = keyframe.state.tick;
  const ReplayIndex& index = archive_->index();
  if (index.keyframes[index.keyframe_before(at)].tick != at) {
    return core::fail(reader_->place(),
                      core::joined({"the index leaves out the keyframe of tick ", std::to_string(at)}));
  }
  if (first_difference_) return {};
  std::string unlike = rerun_->difference_to(keyframe);
  if (!unlike.empty())
    first_difference_ = Difference{at, core::joined({"keyframe ", std::to_string(at), ": ", unlike}), {}};
  return {};
}

core::Expected<void> Playback::seek(std::uint64_t tick) {
  if (tick < archive_->first_tick() || tick > archive_->last_tick()) {
    return core::fail(archive_->source().name, core::joined({"has no tick ", std::to_string(tick)}),
                      core::joined({std::to_string(archive_->first_tick()), " to ",
                                    std::to_string(archive_->last_tick())}));
  }
  const std::size_t keyframe = archive_->index().keyframe_before(tick);
  const bool is_in_reach =
      reader_ && this->tick() <= tick && this->tick() >= archive_->index().keyframes[keyframe].tick;
  if (!is_in_reach) {
    if (auto restored = restore(keyframe); !restored) return restored;
  }
  while (this->tick() < tick) {
    const core::Expected<std::optional<PlayedStep>> step = advance();
    if (!step) return tl::unexpected(step.error());
    if (!*step)
      return core::fail(archive_->source().name, core::joined({"ends before tick ", std::to_string(tick)}));
    const std::uint64_t most = std::min(tick - this->tick(), reader_->quiet_steps());
    reader_->skip_quiet(rerun_->stand_still(most));
  }
  return {};
}

core::Expected<std::optional<PlayedStep>> Playback::advance() {
  if (!reader_) return core::fail(archive_->source().name, "the last jump failed", "jump elsewhere");
  PlayedStep played;
  for (;;) {
    core::Expected<std::optional<Line>> line = reader_->next();
    if (!line) return tl::unexpected(line.error());
    if (!*line || std::holds_alternative<End>(**line)) return std::optional<PlayedStep>();
    if (auto* chat = std::get_if<ChatLine>(&**line)) played.chats.push_back(std::move(*chat));
    if (const auto* keyframe = std::get_if<Keyframe>(&**line)) {
      if (auto passed = pass(*keyframe); !passed) return tl::unexpected(passed.error());
    }
    auto* step = std::get_if<StepLine>(&**line);
    if (step == nullptr) continue;
    auto difference = rerun_->step(*step, reader_->place());
    if (!difference) return tl::unexpected(difference.error());
    played.recorded = std::move(*step);
    played.hash = match().hash();
    if (!first_difference_) first_difference_ = std::move(*difference);
    return std::optional(std::move(played));
  }
}

}  // namespace woodlouse::replay
