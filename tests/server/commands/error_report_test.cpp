#include "server/commands/error_report.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "server/commands/inspect.h"
#include "tests/replay/recorded_match.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

struct ToldRow {
  std::string who;
  double seconds = 0, error = 0, worst = 0;
  std::uint64_t tick = 0, windows = 0;
  std::string median, most;
};

ToldRow told_row(const std::string& line) {
  ToldRow row;
  std::istringstream in(line);
  in >> row.who >> row.seconds >> row.error >> row.worst >> row.tick >> row.windows >> row.median >> row.most;
  INFO(line);
  REQUIRE(in);
  return row;
}

}  // namespace

TEST_CASE("a recording's error is told for every player and for all, with its twin's ways") {
  const replay::Recording recording = replay::record({.steps = 1300});
  const auto table = error_report(*replay::opened(recording.text()));
  REQUIRE(table);
  const auto lines = lines_of(*table);
  REQUIRE(lines.size() > 5);
  double seconds = 0.0, sum = 0.0, worst = 0.0;
  std::uint64_t windows = 0;
  for (std::size_t i = 3; i + 1 < lines.size(); ++i) {
    const ToldRow row = told_row(lines[i]);
    seconds += row.seconds;
    sum += row.error * row.seconds;
    worst = std::max(worst, row.worst);
    windows += row.windows;
    CHECK(row.tick < 1300);
  }
  const ToldRow all = told_row(lines.back());
  CHECK(all.who == "all");
  CHECK(all.error > 0.0);
  CHECK(all.error < 1e-2);
  CHECK(all.error * all.seconds == Approx(sum).epsilon(0.02));
  CHECK(all.seconds == Approx(seconds).margin(0.5));
  CHECK(all.worst == worst);
  CHECK(all.windows == windows);
}

TEST_CASE("inspect tells the error alone, and of an altered recording that it is not to be had") {
  const auto file = std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / "error_report.jsonl";
  InspectRequest request;
  request.file = file;
  request.error = true;
  const auto run = [&](const std::string& text, std::ostringstream& out, std::ostringstream& errors) {
    std::ofstream(file, std::ios::binary) << text;
    return inspect_command(request, out, errors);
  };
  replay::Recording recording = replay::record({.steps = 100});
  std::ostringstream out, errors;
  CHECK(run(recording.text(), out, errors) == 0);
  CHECK(out.str().find("error: ") == 0);
  CHECK(out.str().find("margin") == std::string::npos);
  std::string& line = recording.lines[recording.line_of_step(40)];
  line[line.size() - 4] = line[line.size() - 4] == '0' ? '1' : '0';
  std::ostringstream none;
  CHECK(run(recording.text(), none, errors) == 1);
  CHECK(none.str().empty());
  CHECK(errors.str().find("differs at tick 41") != std::string::npos);
  std::filesystem::remove(file);
}
