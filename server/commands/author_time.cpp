#include "server/commands/author_time.h"

#include <spdlog/fmt/fmt.h>

#include <cassert>
#include <cstdint>
#include <system_error>

#include "server/records/ghost_line.h"
#include "shared/core/printable.h"
#include "shared/match/ghost.h"
#include "shared/match/match.h"
#include "shared/protocol/records.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMend = "put the ghost of a run on this very map there, or take it away";

/// What can't be looked at is there: reading it says why it can't.
bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::symlink_status(file, error).type() != fs::file_type::not_found;
}

/// Of another rate than rooms usually have: which one. Its time is another room's.
std::string rate_text(std::uint32_t tick_hz) {
  return tick_hz == match::MatchSettings().tick_hz ? "" : fmt::format(", at {} ticks/s", tick_hz);
}

}  // namespace

core::Expected<std::string> judge_author_time(const map::Map& map, const fs::path& map_file) {
  assert(map.definition.modes.race && !map_file.empty());
  const std::uint64_t author_ms = map.definition.modes.race->author_ms;
  const fs::path from_map = fs::path("ghosts") / (map_file.stem().string() + ".json");
  const fs::path file = map_file.parent_path() / from_map;
  const std::string called = core::printable(from_map.string());
  if (!is_there(file)) {
    if (author_ms == 0) return std::string();
    return fmt::format("race.author_ms: nothing proves it: there is no {} beside the map", called);
  }
  const auto ghost = read_ghost_file_within(map_file.parent_path(), file);
  if (!ghost) {
    const core::Error& error = ghost.error();
    return core::fail(error.where, error.what, error.hint.empty() ? kMend : error.hint);
  }
  if (ghost->behavior != match::kBehavior)
    return fmt::format("race.author_ms: {} is of behavior {}, can't be re-run here", called, ghost->behavior);
  const std::string why = match::why_not_proven(map, ghost->tick_hz, ghost->ghost, times_of(*ghost));
  if (!why.empty())
    return core::fail(file.string(), "does not prove the map's race.author_ms: " + why, kMend);
  const std::uint64_t proved_ms = whole_milliseconds(ghost->run.time, ghost->tick_hz);
  if (proved_ms != author_ms)
    return core::fail(map_file.string(),
                      fmt::format("race.author_ms: is {}, but {} proves {}", author_ms, called, proved_ms),
                      fmt::format("make it {}, or take the ghost away", proved_ms));
  return fmt::format("race.author_ms: proved by {} (\"{}\", {:.3f} s{})", called,
                     core::printable(ghost->run.name), static_cast<double>(proved_ms) / 1000.0,
                     rate_text(ghost->tick_hz));
}

}  // namespace woodlouse::server
