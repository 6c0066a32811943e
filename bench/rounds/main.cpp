// woodlouse-rounds: the house's bots and blind players play a map's mode for so long, and what came of it.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "bench/option_failure.h"
#include "bench/rounds/season.h"
#include "server/records/ghost_line.h"
#include "shared/core/printable.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/protocol/codec.h"

namespace {

using namespace woodlouse;

struct Options {
  std::vector<std::string> maps;
  std::string mode = "race", skill = "fair", ghost;
  std::uint32_t bots = 8, rounds = 0, tick_hz = 60;
  double minutes = 60.0, hopeless = bench::SeasonSettings().hopeless_behind;
  std::uint64_t seed = 1;
  bool blind = false, shows_rounds = false;
};

/// The season's best run into the file. It has no date: the same command writes the same bytes.
int write_ghost(const bench::Season& season, const Options& options) {
  const std::string file = core::printable(options.ghost);
  const auto& best = season.best_run();
  if (!best) {
    std::fprintf(stderr, "%s: nothing is written: no run from rest came to its end; play more of them\n",
                 file.c_str());
    return 1;
  }
  const protocol::RecordRun run{protocol::Board::kBots, best->name, state::Role::kBot, 0, {}, 0};
  std::ofstream out(options.ghost, std::ios::binary);
  out << protocol::encode(server::line_of(best->driven, options.tick_hz, run)) << std::flush;
  if (!out) {
    std::fprintf(stderr, "%s: can't be written\n", file.c_str());
    return 1;
  }
  const double seconds = static_cast<double>(best->driven.time) / rules::kMomentsPerTick / options.tick_hz;
  std::printf("  %s: %s, %.6f s, done after %.1f s of the game: author_ms %" PRIu64 "\n", file.c_str(),
              best->name.c_str(), seconds,
              static_cast<double>(best->driven.ended) / rules::kMomentsPerTick / options.tick_hz,
              server::whole_milliseconds(best->driven.time, options.tick_hz));
  return 0;
}

int play(const std::string& word, const Options& options) {
  const auto file = map::find_map(word);
  const auto map = file ? map::load_map(*file) : tl::unexpected(file.error());
  const auto mode = state::mode_from_text(options.mode);
  if (!map || !mode || *mode == state::Mode::kRoam || !(*map)->definition.modes.has(*mode)) {
    std::fprintf(stderr, "%s: no map with that mode\n", word.c_str());
    return 1;
  }
  bench::SeasonSettings settings;
  settings.match = {options.tick_hz, options.seed, *mode};
  settings.bots = options.bots;
  settings.skill = *server::bots::skill_from_text(options.skill);
  if (options.blind) settings.blind = {bench::BlindKind::kSpace, bench::BlindKind::kSpaceAndA};
  settings.rounds = options.rounds;
  settings.wants_ghost = !options.ghost.empty();
  settings.hopeless_behind = options.hopeless;
  if (options.rounds == 0)
    settings.ticks = static_cast<std::uint64_t>(options.minutes * 60.0 * options.tick_hz);
  bench::Season season(*map, settings);
  season.play();

  std::printf("%s/%s: %u %s bots, %.0f s, %zu rounds\n", (*map)->definition.name.c_str(),
              options.mode.c_str(), options.bots, options.skill.c_str(), season.seconds(),
              season.results().size());
  if (options.shows_rounds) {
    std::printf("%6s %12s %10s  %s\n", "round", "with result", "score", "first");
    for (const bench::RoundResult& round : season.results())
      std::printf("%6u %12zu %10.3f  %s\n", round.number, round.finishers,
                  *mode == state::Mode::kRace
                      ? static_cast<double>(round.score) / rules::kMomentsPerTick / options.tick_hz
                      : static_cast<double>(round.score),
                  round.winner.c_str());
  }
  std::printf("  %-12s %5s %8s %5s %5s %9s %9s %9s %9s %8s %6s\n", "player", "wins", "points", "laps", "runs",
              "best lap", "mean lap", "best run", "from rest", "respawns", "stuck");
  std::uint64_t stuck = 0;
  for (const auto& [louse, one] : season.records()) {
    std::printf("  %-12s %5ju %8ju %5ju %5ju %9.3f %9.3f %9.3f %9.3f %8ju %6ju\n", one.name.c_str(),
                std::uintmax_t{one.wins}, std::uintmax_t{one.points}, std::uintmax_t{one.laps},
                std::uintmax_t{one.runs}, one.best_lap_s,
                one.laps == 0 ? 0.0 : one.laps_s / static_cast<double>(one.laps), one.best_run_s,
                one.best_from_rest_s, std::uintmax_t{one.respawns}, std::uintmax_t{one.stuck});
    stuck += louse <= options.bots ? one.stuck : 0;
  }
  std::printf("  stuck bots: %ju\n", std::uintmax_t{stuck});
  const int exit_code = options.ghost.empty() ? 0 : write_ghost(season, options);
  std::printf("\n");
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Plays rounds of a map's mode with the house's bots alone, as fast as it goes.",
               "woodlouse-rounds");
  app.add_option("MAP", options.maps, "map files, or names of shipped ones")->required();
  app.add_option("--mode", options.mode)
      ->check(CLI::IsMember({"race", "forage", "hill"}))
      ->capture_default_str();
  app.add_option("--bots", options.bots)->check(CLI::Range(0, 1000))->capture_default_str();
  app.add_option("--bots-skill", options.skill)
      ->check(CLI::IsMember({"easy", "fair", "hard"}))
      ->capture_default_str();
  app.add_option("--minutes", options.minutes, "of the game")
      ->check(CLI::Range(0.01, 1e4))
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "to play instead")->check(CLI::Range(0, 1000));
  app.add_option("--tick-hz", options.tick_hz)->check(CLI::Range(10, 1000))->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_flag("--blind", options.blind,
               "two more players, who look at nothing: Space; Space, and A once a second");
  app.add_option("--ghost", options.ghost,
                 "of one map's race: a file, into which the best run goes that began at rest and is the same "
                 "re-run alone, as woodlouse-server records add takes it; each run begins anew at a spawn");
  app.add_option(
         "--hopeless", options.hopeless,
         "with --ghost: seconds behind the best run at a gate, from which on one is given up; few where "
         "runs differ much")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_flag("--each", options.shows_rounds, "print each round");
  app.failure_message(bench::option_failure);
  CLI11_PARSE(app, argc, argv);
  if (!options.ghost.empty() && (options.maps.size() != 1 || options.mode != "race")) {
    std::fputs("--ghost: is of one map's race\n", stderr);
    return 2;
  }
  int exit_code = 0;
  for (const std::string& map : options.maps) exit_code = std::max(exit_code, play(map, options));
  return exit_code;
}
