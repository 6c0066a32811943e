#include "shared/replay/playback.h"
#include "shared/replay/line_reader.h"

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
  auto rerun =
      Rerun::from(archive_->map(), {header.tick_hz, header.seed}, std::move(*found), reader->place());
  if (!rerun) return tl::unexpected(rerun.error());
  reader_ = std::move(reader);
  rerun_ = std::move(*rerun);
  first_difference_.reset();
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
    auto* step = std::get_if<StepLine>(&**line);
    if (step == nullptr) continue;
    const auto difference = rerun_->step(*step, reader_->place());
    if (!difference) return tl::unexpected(difference.error());
    played.recorded = std::move(*step);
    played.hash = match().hash();
    if (*difference && !first_difference_) first_difference_ = (*difference)->tick;
    return std::optional(std::move(played));
  }
}

}  // namespace woodlouse::replay
