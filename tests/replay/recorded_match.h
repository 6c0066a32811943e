// A real match with random players, played in memory and recorded: what the replay tests alter and re-run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/replay/archive.h"
#include "shared/replay/verify.h"

namespace woodlouse::replay {

enum class Notes { kNone, kNamesAndMargins };

struct Scenario {
  std::uint64_t seed = 1;
  std::uint64_t steps = 400;
  std::uint32_t keyframe_ticks = 60;
  std::string surface = "spline";
  Notes notes = Notes::kNamesAndMargins;
};

struct Recording {
  std::string bytes;                      ///< as written
  std::vector<std::string> lines;         ///< each with its newline, to be altered; of a plain one
  std::vector<match::MatchState> states;  ///< [k]: at tick k + 1
  std::size_t overtaken = 0;              ///< inputs applied after one of a higher seq
  std::size_t inputs = 0;
  std::size_t leaves = 0;
  std::size_t respawns = 0;

  /// The lines as they are now.
  [[nodiscard]] std::string text() const;
  /// Those lines with an index and an end made anew, as whoever alters the others can.
  [[nodiscard]] std::string text_with_own_index() const;
  /// The index of the line of that step.
  [[nodiscard]] std::size_t line_of_step(std::uint64_t step) const;
};

std::shared_ptr<const map::Map> small_map(const std::string& surface);

/// Players join, steer, ask for later ticks out of order, respawn and leave.
Recording record(const Scenario& scenario);
/// The same game, recorded as zstd frames.
Recording record_packed(const Scenario& scenario);

core::Expected<Verification> verify_text(const std::string& text, const std::filesystem::path& folder = {});

/// A recording that must open; fails the test otherwise.
std::shared_ptr<const ReplayArchive> opened(const std::string& bytes);

/// All of a state, to be compared.
std::string state_text(const match::MatchState& state);

/// The verdict of a recording that must be readable; fails the test otherwise.
Verification verdict(const std::string& text);

/// The first number that stands after `key` at or after `from`; begin and end are offsets into `line`.
struct NumberPlace {
  std::size_t begin = std::string::npos;
  std::size_t end = 0;
};
NumberPlace find_number(const std::string& line, const std::string& key, std::size_t from = 0);

}  // namespace woodlouse::replay
