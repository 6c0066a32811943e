// Writes short recordings of real matches for the replay target to start from: their hashes are those of the
// build at hand, so that they re-run to their end.
//
//     woodlouse_seed_recordings FOLDER
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/replay/writer.h"

namespace {

using namespace woodlouse;

struct Seed {
  std::string_view name;
  std::string_view map;
  std::uint64_t steps;
  bool drives = true;  ///< else nobody does, and most steps do nothing
};

constexpr Seed kSeeds[] = {
    {"function", R"({"name":"f","terrain":{"function":"wavy_pot","grid":2,"scale":10},"surface":"function"})",
     40},
    {"spline", R"({"name":"s","terrain":{"spacing":2,"heights":[[0,1,0,1],[1,0,0,1],[0,0,1,0],[1,0,0,0]]}})",
     25},
    {"plane", R"({"name":"p","terrain":{"spacing":2,"heights":[[0,1,2,3],[1,2,3,4],[2,3,4,5],[3,4,5,6]]}})",
     25},
    {"flight",
     R"({"name":"j","terrain":{"function":"hills","scale":20},"surface":"function","physics":{"gravity":2,"contact":"unilateral","method":"cheap"},"spawns":[{"position":[0,0],"speed":30}]})",
     12},
    {"rest", R"({"name":"r","terrain":{"spacing":2,"heights":[[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]}})",
     45, false},
};

/// Lice come, steer, ask for later ticks out of order, respawn and leave.
std::string recording(const Seed& seed, replay::Encoding encoding) {
  const auto map = map::parse_map(seed.map, seed.name, {});
  if (!map) {
    std::fprintf(stderr, "%s\n", map.error().text().c_str());
    return {};
  }
  match::Match match(*map, {60, 7});
  replay::ReplayWriter writer(encoding);
  core::Random random(1);
  std::string out;
  writer.append_header(out, replay::make_header(match, "fuzz", "m.json"));
  writer.append_keyframe(out, match.state());
  std::uint32_t seq = 0;
  for (std::uint64_t step = 0; step < seed.steps; ++step) {
    if (step % 12 == 0) match.join({"louse", state::Role::kBot});
    if (step == 20) match.respawn(1);
    if (step == 30) match.leave(2);
    if (seed.drives && step % 3 == 0) {
      match::Input input;
      input.player = 1;
      input.seq = ++seq;
      input.thrust = step % 2 == 0 ? state::Thrust{state::ThrustKind::kMapVector, {0.5, -0.25}}
                                   : state::Thrust{state::ThrustKind::kAlongHeading, {0.75, 0.0}};
      input.wanted_tick = match.tick() + random.next() % 8;
      if (step % 4 == 0) input.ticks = 5;
      match.file(input);
      writer.note_margin(1, input.seq, 1500);
    }
    if (step == 5) writer.append_chat(out, step, 1, "louse", "hello");
    const match::StepRecord& record = match.advance();
    writer.append_step(out, record);
    constexpr std::uint64_t kKeyframeTicks = 10;  // more of them than a server writes
    if (match.tick() % kKeyframeTicks == 0) writer.append_keyframe(out, match.state());
  }
  writer.append_end(out, "done");
  writer.flush(out);
  return out;
}

/// The replay target packs what stands behind these: no lie, a frame's text told longer and the next's
/// shorter, a frame's bytes told fewer.
constexpr std::string_view kPackings[] = {{"P\0", 2}, {"P\2\1\1\7\2\1\xf9", 8}, {"P\1\1\0\xff", 5}};

bool is_written(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!bytes.empty() && out.flush()) return true;
  std::fprintf(stderr, "%s: can't be written\n", file.c_str());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: woodlouse_seed_recordings FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const Seed& seed : kSeeds) {
    for (const std::string_view ending : {".ndjson", ".ndjson.zst"}) {
      const std::filesystem::path file = folder / (std::string(seed.name) + std::string(ending));
      if (!is_written(file, recording(seed, replay::encoding_of(file.string())))) return 1;
    }
    for (std::size_t k = 0; k < std::size(kPackings); ++k) {
      const std::filesystem::path file =
          folder / (std::string(seed.name) + "." + std::to_string(k) + ".packing");
      if (!is_written(file, std::string(kPackings[k]) + recording(seed, replay::Encoding::kPlain))) return 1;
    }
  }
  return 0;
}
