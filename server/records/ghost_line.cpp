#include "server/records/ghost_line.h"

#include <cassert>
#include <utility>
#include <variant>

#include "shared/core/whole_file.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

core::Expected<protocol::GhostLine> read_text(const core::Expected<std::string>& text, const fs::path& file) {
  if (!text) return tl::unexpected(text.error());
  return read_ghost_line(*text, file.string());
}

}  // namespace

match::RunTimes times_of(const protocol::GhostLine& ghost) {
  match::RunTimes times;
  times.gates.push_back(ghost.start);
  for (const std::uint64_t split : ghost.run.splits) times.gates.push_back(ghost.start + split);
  return times;
}

protocol::GhostLine line_of(const match::DrivenRun& driven, std::uint32_t tick_hz, protocol::RecordRun run) {
  assert(driven.is_kept && driven.times.gates.size() > 1);
  assert(driven.times.time() == driven.time);
  protocol::GhostLine line;
  line.run = std::move(run);
  line.run.time = driven.time;
  line.start = driven.times.gates.front();
  line.run.splits.clear();
  for (std::size_t k = 1; k < driven.times.gates.size(); ++k)
    line.run.splits.push_back(driven.times.gates[k] - line.start);
  line.behavior = match::kBehavior;
  line.tick_hz = tick_hz;
  line.ghost = driven.ghost;
  return line;
}

/// Of any time that a line can state: whole ticks first, so that nothing overflows.
std::uint64_t whole_milliseconds(rules::Moment time, std::uint32_t tick_hz) {
  assert(tick_hz >= 1 && tick_hz <= 1000);
  const std::uint64_t per_second = rules::kMomentsPerTick * tick_hz;
  const std::uint64_t rest = time % per_second * 1000;
  return time / per_second * 1000 + (rest + per_second - 1) / per_second;
}

core::Expected<protocol::GhostLine> read_ghost_line(std::string_view line, const std::string& place) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  auto message = protocol::decode_server(line, {}, protocol::Format::kQuantized);
  if (!message) return core::fail(place, message.error().text);
  auto* ghost = std::get_if<protocol::GhostLine>(&*message);
  if (ghost == nullptr) return core::fail(place, "is no ghost", "one begins with {\"type\":\"ghost\",");
  if (ghost->run.splits.empty() || ghost->run.splits.back() != ghost->run.time)
    return core::fail(place, "its time is not its last split");
  if (ghost->run.role == state::Role::kSpectator) return core::fail(place, "a spectator drives nothing");
  return std::move(*ghost);
}

core::Expected<protocol::GhostLine> read_ghost_file(const fs::path& file) {
  return read_text(core::read_whole_file(file, kMaxGhostBytes), file);
}

core::Expected<protocol::GhostLine> read_ghost_file_within(const fs::path& folder, const fs::path& file) {
  return read_text(core::read_whole_file_within(folder, file, kMaxGhostBytes), file);
}

}  // namespace woodlouse::server
