// A course, runs on it, and a folder for boards.
#pragma once

#include <unistd.h>

#include <spdlog/sinks/ostream_sink.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "server/records/board.h"
#include "server/records/board_file.h"
#include "server/records/ghost_line.h"
#include "shared/map/map_text.h"
#include "shared/match/ghost_tracks.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server::test {

namespace fs = std::filesystem;

/// Level ground that wraps, without friction.
inline std::string ring_text(const std::string& laps, const std::string& name = "ring") {
  std::string heights;
  for (int row = 0; row < 5; ++row) heights += std::string(row ? "," : "") + "[0,0,0,0,0,0,0,0,0]";
  return R"({"name":")" + name + R"(","terrain":{"spacing":5,"heights":[)" + heights +
         R"(]},"edges":"wrap","physics":{"drag":0,"friction":0,"thrust_max":20},)"
         R"("spawns":[{"position":[-16,1]}],"race":{"gates":[{"a":[-15,4],"b":[-15,-4]},{"a":[0,4],"b":[0,-4]}],)" +
         laps + "}}";
}

inline std::shared_ptr<const map::Map> ring_map(const std::string& laps = R"("laps":1)",
                                                const std::string& name = "ring") {
  const auto map = map::parse_map(ring_text(laps, name), "ring", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

/// A run by a push of so much for a second.
inline match::DrivenRun ring_run(const std::shared_ptr<const map::Map>& map, double push) {
  match::Match game(map, {60, 1, state::Mode::kRace});
  match::GhostTracks tracks(60);
  const match::PlayerId player = game.join({"mara", state::Role::kPlayer});
  game.file({player, 1, {state::ThrustKind::kMapVector, {push, 0.0}}, 60, 2});
  for (;;) {
    auto& runs = tracks.take(game.advance());
    if (!runs.empty()) return runs[0];
    REQUIRE(game.tick() < 36'000);
  }
}

inline protocol::GhostLine ghost_line(const match::DrivenRun& run, const std::string& name,
                                      protocol::Board board = protocol::Board::kPeople) {
  return line_of(run, 60, {board, name, state::Role::kPlayer, 0, {}, 1'767'225'600});
}

struct BoardsFolder {
  BoardsFolder()
      : path(fs::temp_directory_path() / ("woodlouse_records_test_" + std::to_string(::getpid()))) {
    fs::remove_all(path);
    fs::create_directory(path);
  }
  ~BoardsFolder() { fs::remove_all(path); }
  BoardsFolder(const BoardsFolder&) = delete;
  BoardsFolder& operator=(const BoardsFolder&) = delete;

  static std::string read(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  static void append(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::app) << text;
  }

  fs::path path;
};

/// A log that a test reads once the board's thread has ended.
struct BoardLog {
  std::ostringstream text;
  std::shared_ptr<spdlog::logger> log = std::make_shared<spdlog::logger>(
      "records", std::make_shared<spdlog::sinks::ostream_sink_mt>(text, true));
  [[nodiscard]] bool has(const std::string& part) const { return text.str().find(part) != std::string::npos; }
};

}  // namespace woodlouse::server::test
