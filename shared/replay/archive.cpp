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

/// Its first keyframe stands behind the header, its last one where it says, and from there steps lead to its
/// last tick, itself and the end: so far a recording's two ends are known. Each place between is looked at
/// when it is used (playback.cpp).
bool ReplayArchive::is_index_sound(InputStream& in) const {
  in.clear();
  in.seekg(0);
  ReplayReader reader(in, source_.name);
  if (!reader.read_header()) return false;
  const auto is_keyframe = [](const core::Expected<std::optional<Line>>& line, std::uint64_t tick) {
    const auto* keyframe = line && *line ? std::get_if<Keyframe>(&**line) : nullptr;
    return keyframe != nullptr && keyframe->state.tick == tick;
  };
  const KeyframePlace& first = index_.keyframes.front();
  if (!is_keyframe(reader.next(), first.tick) ||
      first != KeyframePlace{first.tick, reader.line_offset(), reader.line_number()})
    return false;
  const KeyframePlace& last = index_.keyframes.back();
  in.clear();
  in.seekg(static_cast<std::streamoff>(last.offset));
  ReplayReader tail(in, source_.name);
  if (!is_keyframe(tail.next(), last.tick)) return false;
  for (bool has_index = false;;) {
    const auto line = tail.next_line();
    if (!line || !*line || std::holds_alternative<Keyframe>(**line)) return false;
    if (const auto* index = std::get_if<IndexLine>(&**line)) {
      has_index = index->tick == index_.last_tick && index_.end &&
                  last.offset + tail.line_offset() == index_.end->index_offset;
    }
    if (std::holds_alternative<End>(**line)) return has_index;
  }
}

core::Expected<std::unique_ptr<Playback>> ReplayArchive::play(std::uint64_t tick) const {
  std::unique_ptr<Playback> playback(new Playback(shared_from_this()));
  if (auto sought = playback->seek(tick); !sought) return tl::unexpected(sought.error());
  return playback;
}

}  // namespace woodlouse::replay
