// How fast recordings are verified and looked into: plays games of its own into a folder, and times what
// `woodlouse-server verify` and `inspect` do with them.
//
// Usage: woodlouse-replay-speed MAP FOLDER
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/replay/inspect.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/source_file.h"
#include "shared/replay/writer.h"

namespace {

using namespace woodlouse;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kTickHz = 60;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Game {
  const char* name;
  std::uint32_t players;
  std::uint32_t seconds;
};

/// Every player pushes ten times a second in a random direction.
void play(const std::shared_ptr<const map::Map>& map, const Game& game, const std::filesystem::path& file) {
  match::Match match(map, {kTickHz, 7});
  core::Random random(1);
  replay::ReplayWriter writer(replay::encoding_of(file.string()));
  std::ofstream out(file, std::ios::binary);
  std::string bytes;
  writer.append_header(bytes, replay::make_header(match, "woodlouse-replay-speed", ""));
  writer.append_keyframe(bytes, match.state());
  for (std::uint32_t player = 0; player < game.players; ++player) match.join({"bot", state::Role::kBot});
  std::vector<std::uint32_t> seqs(game.players, 0);
  while (match.tick() < std::uint64_t{game.seconds} * kTickHz) {
    for (std::uint32_t player = 1; match.tick() > 0 && player <= game.players; ++player) {
      if (random.next() % 6 != 0) continue;
      core::Vec2 push;
      do {
        push = {static_cast<double>(random.next() % 257) / 128.0 - 1.0,
                static_cast<double>(random.next() % 257) / 128.0 - 1.0};
      } while (core::dot(push, push) > 1.0);
      const std::uint32_t seq = ++seqs[player - 1];
      match.file({player, seq, {state::ThrustKind::kMapVector, push}, state::kHeld, 0});
      writer.note_margin(player, seq, static_cast<std::int64_t>(random.next() % 16'667));
    }
    writer.append_step(bytes, match.advance());
    if (match.tick() % replay::keyframe_ticks(kTickHz) == 0) writer.append_keyframe(bytes, match.state());
    if (match.tick() % 30 == 0) writer.flush(bytes);
    out << bytes;
    bytes.clear();
  }
  writer.append_end(bytes, "played");
  out << bytes;
}

int time_verify(const Game& game, const std::filesystem::path& file) {
  for (const unsigned jobs : {1u, std::max(2u, std::thread::hardware_concurrency())}) {
    const auto start = Clock::now();
    const auto verification = replay::verify(replay::source_of_file(file), jobs);
    const double taken = seconds_since(start);
    if (!verification || !verification->ok()) {
      std::cerr << (verification ? to_text(*verification) : verification.error().text()) << '\n';
      return 1;
    }
    std::printf("verify --jobs %-2u %-34s %8.2f s %8.0f x real time\n", jobs, game.name, taken,
                game.seconds / taken);
  }
  return 0;
}

int time_inspect(const Game& game, const std::filesystem::path& file) {
  constexpr int kRounds = 25;
  core::Random random(3);
  std::vector<double> taken;
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t tick = random.next() % (std::uint64_t{game.seconds} * kTickHz);
    const auto start = Clock::now();
    const auto archive = replay::ReplayArchive::open(replay::source_of_file(file));
    if (!archive || !replay::inspect_state(**archive, tick)) return 1;
    taken.push_back(1000.0 * seconds_since(start));
  }
  std::sort(taken.begin(), taken.end());
  std::printf(
      "inspect --tick   %-34s %8.1f ms median, %.1f ms worst of %d; opening the file and its map included\n",
      game.name, taken[kRounds / 2], taken.back(), kRounds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool keeps = argc == 4 && std::string_view(argv[3]) == "--keep";
  if (argc != 3 && !keeps) {
    std::cerr << "usage: woodlouse-replay-speed MAP FOLDER [--keep]   (--keep: the last of each kind stays "
                 "there)\n";
    return 2;
  }
  const auto map = map::load_map(argv[1]);
  if (!map) {
    std::cerr << map.error().text() << '\n';
    return 1;
  }
  const Game games[] = {{"200 lice, 10 min, .ndjson", 200, 600},
                        {"200 lice, 10 min, .ndjson.zst", 200, 600},
                        {"100 lice, 1 hour, .ndjson.zst", 100, 3600}};
  for (const Game& game : games) {
    const std::string name = game.name;
    const auto file = std::filesystem::path(argv[2]) / ("speed" + name.substr(name.rfind(" .") + 1));
    const auto start = Clock::now();
    play(*map, game, file);
    std::printf("played           %-34s %8.1f s, %.1f MB\n", game.name, seconds_since(start),
                static_cast<double>(std::filesystem::file_size(file)) / 1e6);
    if (time_verify(game, file) != 0 || time_inspect(game, file) != 0) return 1;
    if (!keeps) std::filesystem::remove(file);
  }
  return 0;
}
