// A small scenario in a folder of its own, to be altered.
#pragma once

#include <unistd.h>
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "bench/scenario/session.h"

namespace woodlouse::scenario {

/// Valid but for its hashes, which are not known yet.
inline constexpr std::string_view kSmall = R"({
  "about": "a test",
  "behavior": 0,
  "map": {
    "name": "small",
    "terrain": {"function": "volcano", "grid": 4, "scale": 10}
  },
  "spawns": [{"position": [3, 0], "heading": 90, "speed": 1}],
  "seed": 1,
  "script": [
    {"at": 0, "join": 3},
    {"at": 2, "player": 1, "thrust": [0.5, 0], "ticks": 5}
  ],
  "hashes": {"10": null, "20": null}
}
)";

/// A fresh folder with a file `small.json`; gone with its owner.
class WrittenScenario {
 public:
  explicit WrittenScenario(std::string_view text = kSmall) {
    static int count = 0;
    folder_ = std::filesystem::path(WOODLOUSE_BINARY_DIR) /
              ("scenario_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
    write("small.json", text);
  }
  ~WrittenScenario() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
    if (error) WARN(error.message());
  }
  WrittenScenario(const WrittenScenario&) = delete;
  WrittenScenario& operator=(const WrittenScenario&) = delete;

  void write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "small.json"; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// What a run said and returned.
struct Said {
  Exit exit = Exit::kUnusable;
  std::string out;
  std::string log;
};

inline Said run(Options options, const std::filesystem::path& place) {
  options.places = {place};
  std::ostringstream out;
  std::ostringstream log;
  const Exit exit = Session(options, out, log).run();
  return {exit, out.str(), log.str()};
}

inline Said update(const std::filesystem::path& place) {
  Options options;
  options.goldens = Goldens::kUpdate;
  return run(options, place);
}

/// `text` with the first `from` made `to`; fails the test where there is none.
inline std::string with(std::string_view text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string_view::npos) FAIL("no " << from);
  return std::string(text).replace(at, from.size(), to);
}

}  // namespace woodlouse::scenario
