#include "shared/replay/archive.h"

#include <utility>

#include "shared/replay/line_reader.h"
#include "shared/replay/rerun.h"

namespace woodlouse::replay {

ReplayArchive::ReplayArchive(ReplaySource source, Header header, std::shared_ptr<const map::Map> map,
                             ReplayIndex index)
    : source_(std::move(source)),
      header_(std::move(header)),
      map_(std::move(map)),
      index_(std::move(index)) {}

core::Expected<std::shared_ptr<const ReplayArchive>> ReplayArchive::open(ReplaySource source) {
  const auto stream = source.open();
  if (!stream) return tl::unexpected(stream.error());
  core::Expected<Header> header = ReplayReader(**stream, source.name).read_header();
  if (!header) return tl::unexpected(header.error());
  const auto map = recorded_map(*header, source);
  if (!map) return tl::unexpected(map.error());
  std::optional<ReplayIndex> index = read_index(**stream, source.name);
  if (index) {
    std::shared_ptr<ReplayArchive> archive(new ReplayArchive(source, *header, *map, std::move(*index)));
    if (archive->is_index_sound(**stream)) return archive;
  }
  core::Expected<ReplayIndex> scanned = scan_index(**stream, source.name);
  if (!scanned) return tl::unexpected(scanned.error());
  return std::shared_ptr<const ReplayArchive>(
      new ReplayArchive(std::move(source), std::move(*header), *map, std::move(*scanned)));
}

/// Its first and last keyframe stand where it says.
bool ReplayArchive::is_index_sound(std::istream& in) const {
  for (const KeyframePlace& place : {index_.keyframes.front(), index_.keyframes.back()}) {
    in.clear();
    in.seekg(static_cast<std::streamoff>(place.offset));
    const auto line = ReplayReader(in, source_.name).next();
    if (!line || !*line) return false;
    const auto* keyframe = std::get_if<Keyframe>(&**line);
    if (keyframe == nullptr || keyframe->state.tick != place.tick) return false;
  }
  return true;
}

core::Expected<std::unique_ptr<Playback>> ReplayArchive::play(std::uint64_t tick) const {
  std::unique_ptr<Playback> playback(new Playback(shared_from_this()));
  if (auto sought = playback->seek(tick); !sought) return tl::unexpected(sought.error());
  return playback;
}

}  // namespace woodlouse::replay
