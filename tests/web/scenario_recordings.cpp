// Writes each scenario as a recording, plain and packed: what core.wasm has to re-run to the same hashes.
//
//     woodlouse_scenario_recordings SCENARIOS FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "bench/scenario/play.h"
#include "bench/scenario/scenario_reader.h"
#include "shared/replay/writer.h"

namespace {

using namespace woodlouse;

std::string recording(const scenario::Scenario& scenario, replay::Encoding encoding) {
  scenario::Play play(scenario, physics::best_instruction_set());
  const match::Match& match = play.match();
  replay::ReplayWriter writer(encoding);
  std::string out;
  writer.append_header(out, replay::make_header(match, "scenario", scenario.file.string()));
  writer.append_keyframe(out, match.state());
  while (!play.is_done()) {
    play.advance(1);
    writer.append_step(out, play.last_step());
    if (match.tick() % replay::keyframe_ticks(scenario.settings.tick_hz) == 0)
      writer.append_keyframe(out, match.state());
  }
  writer.append_end(out, "the scenario's end");
  writer.flush(out);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: woodlouse_scenario_recordings SCENARIOS FOLDER\n");
    return 2;
  }
  const auto files = scenario::find_scenarios({argv[1]});
  if (!files) {
    std::fprintf(stderr, "%s\n", files.error().text().c_str());
    return 1;
  }
  std::filesystem::create_directories(argv[2]);
  for (const std::filesystem::path& file : *files) {
    const scenario::ReadScenario read = scenario::read_scenario(file, {});
    if (!read.scenario || !replay::holds_map(*read.scenario->map)) {
      std::fprintf(stderr, "%s: no scenario, or its map does not fit into a recording\n", file.c_str());
      return 1;
    }
    const std::filesystem::path plain = std::filesystem::path(argv[2]) / (read.scenario->name + ".ndjson");
    std::ofstream(plain, std::ios::binary) << recording(*read.scenario, replay::Encoding::kPlain);
    std::ofstream(plain.string() + ".zst", std::ios::binary)
        << recording(*read.scenario, replay::Encoding::kZstd);
  }
}
