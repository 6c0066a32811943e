#include "shared/replay/replayer.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <ostream>
#include <utility>

#include "shared/core/joined.h"
#include "shared/map/map_loader.h"
#include "shared/replay/replay_file.h"
#include "shared/replay/rerun.h"

namespace woodlouse::replay {
namespace {

using core::joined;
using MapPointer = std::shared_ptr<const map::Map>;

core::Expected<MapPointer> load_named_map(const Header& header, const std::filesystem::path& folder) {
  const std::filesystem::path recorded(header.map_file);
  std::error_code error;
  const std::filesystem::path beside = folder / recorded.filename();
  return map::load_map(std::filesystem::exists(beside, error) ? beside : recorded);
}

/// The recorded map, proven to be it by its hash.
core::Expected<MapPointer> map_of(const Header& header, const std::string& source,
                                  const std::filesystem::path& folder) {
  core::Expected<MapPointer> map =
      header.map_definition.empty()
          ? load_named_map(header, folder)
          : map::parse_map(header.map_definition, joined({source, ":1: map.definition"}), {});
  if (map && (*map)->hash != header.map_hash) {
    return core::fail(joined({source, ":1: map.hash"}),
                      joined({"the map's hash is ", core::to_hex((*map)->hash), ", recorded is ",
                              core::to_hex(header.map_hash)}),
                      header.map_definition.empty() ? "put the map it was played on beside the recording"
                                                    : "the map in the recording was altered");
  }
  return map;
}

/// Reads until the end, or until nothing more can be learned.
core::Expected<Verification> run(ReplayReader& reader, Rerun& rerun) {
  std::optional<End> end;
  while (!rerun.is_settled()) {
    core::Expected<std::optional<Line>> line = reader.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) break;
    const std::string place = joined({reader.source(), ":", std::to_string(reader.line_number())});
    if (end) return core::fail(place, "stands after the end");
    core::Expected<void> added;
    if (auto* step = std::get_if<StepLine>(&**line)) added = rerun.add(std::move(*step), place);
    if (auto* keyframe = std::get_if<Keyframe>(&**line)) added = rerun.add(std::move(*keyframe), place);
    if (!added) return tl::unexpected(added.error());
    if (const auto* last = std::get_if<End>(&**line)) {
      end = *last;
      if (end->tick != rerun.steps_read()) {
        return core::fail(joined({place, ": end"}),
                          joined({"tick ", std::to_string(end->tick), " after step lines up to tick ",
                                  std::to_string(rerun.steps_read())}),
                          "lines are missing");
      }
    }
  }
  rerun.finish();
  return Verification{rerun.steps_run(), !end && !rerun.difference(), rerun.difference()};
}

}  // namespace

core::Expected<Verification> verify(std::istream& in, const std::string& source,
                                    const std::filesystem::path& folder) {
  ReplayReader reader(in, source);
  const core::Expected<Header> header = reader.read_header();
  if (!header) return tl::unexpected(header.error());
  const core::Expected<MapPointer> map = map_of(*header, source, folder);
  if (!map) return tl::unexpected(map.error());
  Rerun rerun(*map, match::MatchSettings{header->tick_hz, header->seed});
  return run(reader, rerun);
}

std::string to_text(const Verification& verification) {
  const std::string ticks = std::to_string(verification.ticks);
  if (verification.ok()) {
    if (!verification.cut_off) return joined({"ok ", ticks, " ticks\n"});
    return joined({"ok ", ticks, " ticks, then the recording is cut off: it has no end line\n"});
  }
  const Difference& difference = *verification.difference;
  return joined({"differs at tick ", std::to_string(difference.tick), ": ", difference.what, "\n",
                 difference.detail, "\n"});
}

int verify_command(const std::filesystem::path& file, std::ostream& out) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    out << file.string() << ": is a folder, not a recording\n";
    return 1;
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    out << file.string() << ": can't be opened: " << std::strerror(errno) << "\n";
    return 1;
  }
  const core::Expected<Verification> verification = verify(in, file.string(), file.parent_path());
  if (!verification) {
    out << verification.error().text() << "\n";
    return 1;
  }
  out << to_text(*verification);
  return verification->ok() ? 0 : 1;
}

}  // namespace woodlouse::replay
