// Rounds of a map's mode, one after the other, played by the house's bots and by blind players: a match
// alone, without a socket and as fast as it goes. What came of it, by player.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/rounds/blind.h"
#include "server/bots/skill.h"
#include "server/bots/team.h"
#include "shared/match/match.h"

namespace woodlouse::bench {

struct SeasonSettings {
  match::MatchSettings match;
  std::uint32_t bots = 8;
  server::bots::Skill skill = server::bots::Skill::kFair;
  std::vector<BlindKind> blind;
  std::uint64_t ticks = 0;   ///< to play; 0: by rounds alone
  std::uint32_t rounds = 0;  ///< to end after; 0: by ticks alone
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
};

struct RoundResult {
  std::uint32_t number = 0;
  std::string winner;  ///< empty: nobody has a result
  std::int64_t score = 0;
  std::size_t finishers = 0;  ///< who have one
};

class Season {
 public:
  static constexpr std::uint64_t kStuckAfter = 60;  ///< [s]

  Season(std::shared_ptr<const map::Map> map, SeasonSettings settings);
  void play();

  [[nodiscard]] const std::vector<RoundResult>& results() const { return results_; }
  [[nodiscard]] const std::map<match::PlayerId, Record>& records() const { return records_; }
  [[nodiscard]] double seconds() const { return static_cast<double>(game_.tick()) / settings_.match.tick_hz; }

 private:
  void note(const match::StepRecord& step);
  void note(const rules::Event& event);
  void note_stuck(std::uint64_t tick);
  void end_round(std::uint32_t number);

  SeasonSettings settings_;
  match::Match game_;
  server::bots::Team team_;
  std::vector<std::unique_ptr<std::uint32_t>> seqs_;
  std::vector<BlindPlayer> blind_;
  std::map<match::PlayerId, Record> records_;
  std::vector<RoundResult> results_;
};

}  // namespace woodlouse::bench
