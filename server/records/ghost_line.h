// A ghost's line as files have it: a row of a board, what is handed in, and a race's author's.
// Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/match/ghost.h"
#include "shared/match/ghost_tracks.h"
#include "shared/protocol/records.h"
#include "shared/rules/event.h"

namespace woodlouse::server {

/// The longest file that is read as a ghost.
inline constexpr std::size_t kMaxGhostBytes = 4u << 20;

/// The row's run, as match/ghost.h has it.
match::RunTimes times_of(const protocol::GhostLine& ghost);
/// What was driven here, by this behavior. run: the board, who drove it and when; its times are filled in.
/// REQUIRES a run that is kept.
protocol::GhostLine line_of(const match::DrivenRun& driven, std::uint32_t tick_hz, protocol::RecordRun run);
/// A span of moments as maps state it, rounded up [ms]. tick_hz: 1..1000.
std::uint64_t whole_milliseconds(rules::Moment time, std::uint32_t tick_hz);

/// A ghost's line, or why it is none; where = `place`.
core::Expected<protocol::GhostLine> read_ghost_line(std::string_view line, const std::string& place);
/// The one line of a file that the user named. Errors: those of core::read_whole_file, it is no ghost.
core::Expected<protocol::GhostLine> read_ghost_file(const std::filesystem::path& file);
/// The same of one that he did not: it must lie in `folder` or below it (core/input_file.h).
core::Expected<protocol::GhostLine> read_ghost_file_within(const std::filesystem::path& folder,
                                                           const std::filesystem::path& file);

}  // namespace woodlouse::server
