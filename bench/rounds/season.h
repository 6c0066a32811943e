// Rounds of a map's mode, one after the other, played by the house's bots and by blind players: a match
// alone, without a socket and as fast as it goes. What came of it, by player.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/rounds/blind.h"
#include "server/bots/skill.h"
#include "server/bots/team.h"
#include "shared/match/ghost_tracks.h"
#include "shared/match/match.h"

namespace woodlouse::bench {

struct SeasonSettings {
  match::MatchSettings match;
  std::uint32_t bots = 8;
  server::bots::Skill skill = server::bots::Skill::kFair;
  std::vector<BlindKind> blind;
  std::uint64_t ticks = 0;   ///< to play; 0: by rounds alone
  std::uint32_t rounds = 0;  ///< to end after; 0: by ticks alone
  bool wants_ghost = false;  ///< of a race: each run begins anew at a spawn
  /// Where a ghost is wanted: who is so far behind the best run at a gate begins anew, so that more are tried
  /// [s].
  double hopeless_behind = 0.5;
};

/// Of a player, over all rounds. What a mode has not is 0.
struct Record {
  std::string name;
  std::uint64_t wins = 0;
  std::uint64_t points = 0;  ///< forage, hill
  std::uint64_t laps = 0, runs = 0;
  double best_lap_s = 0.0, best_run_s = 0.0;
  double best_from_rest_s = 0.0;  ///< of the runs that began at rest on a spawn
  double laps_s = 0.0;            ///< sum over all
  std::uint64_t respawns = 0;     ///< by its own wish
  std::uint64_t stuck = 0;        ///< how often it came no further for a minute
  std::uint64_t since = 0;        ///< the tick since which it has come no further
  rules::Moment run_start = 0;    ///< of the run that goes on, where a ghost is wanted
};

struct RoundResult {
  std::uint32_t number = 0;
  std::string winner;  ///< empty: nobody has a result
  std::int64_t score = 0;
  std::size_t finishers = 0;  ///< who have one
};

/// A run that was driven again, alone, and came to the same.
struct ProvedRun {
  std::string name;  ///< whose
  match::DrivenRun driven;
};

class Season {
 public:
  static constexpr std::uint64_t kStuckAfter = 60;  ///< [s]

  Season(std::shared_ptr<const map::Map> map, SeasonSettings settings);
  void play();

  [[nodiscard]] const std::vector<RoundResult>& results() const { return results_; }
  [[nodiscard]] const std::map<match::PlayerId, Record>& records() const { return records_; }
  /// The best of all that began at rest; nothing: there is none, or no ghost was wanted.
  [[nodiscard]] const std::optional<ProvedRun>& best_run() const { return best_run_; }
  [[nodiscard]] double seconds() const { return static_cast<double>(game_.tick()) / settings_.match.tick_hz; }

 private:
  void note(const match::StepRecord& step);
  void note(const rules::Event& event);
  void note_stuck(std::uint64_t tick);
  void keep_best(const match::StepRecord& step);
  /// At a gate: it is too far behind the best run to become a better one.
  bool is_hopeless(const rules::Event& gate);
  void send_to_spawns(const match::StepRecord& step);
  void end_round(std::uint32_t number);

  SeasonSettings settings_;
  std::shared_ptr<const map::Map> map_;
  match::Match game_;
  server::bots::Team team_;
  std::vector<std::unique_ptr<std::uint32_t>> seqs_;
  std::vector<BlindPlayer> blind_;
  std::map<match::PlayerId, Record> records_;
  std::vector<RoundResult> results_;
  match::GhostTracks tracks_;
  std::optional<ProvedRun> best_run_;
};

}  // namespace woodlouse::bench
