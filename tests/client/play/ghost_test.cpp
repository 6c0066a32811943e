#include "client/play/modes/ghosts.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/play/modes/ghost_file.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/map/map_world.h"
#include "shared/protocol/codec.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

std::shared_ptr<const map::Map> map_of(const char* name) {
  auto map = map::load_map(*map::find_map(name));
  REQUIRE(map);
  return std::move(*map);
}

state::Louse louse_on(const map::Map& map) {
  state::Louse louse;
  louse.id = 5;
  louse.position = map.definition.spawns.front().position;
  return louse;
}

/// A drive of `seconds` with a push every second, and where it led.
OwnDrive driven(const map::Map& map, std::uint32_t seconds, state::Louse* end = nullptr) {
  OwnDrive drive{louse_on(map), {}, 60 * seconds, 0};
  physics::World world = map::make_world(map, 1.0 / 60.0);
  world.insert(drive.start);
  for (std::uint32_t tick = 0; tick < drive.ticks; ++tick) {
    if (tick % 60 == 7) {
      const state::Thrust thrust{state::ThrustKind::kMapVector, {0.5, tick % 120 == 7 ? 0.25 : -0.75}};
      world.set_thrust(5, thrust, 30);
      drive.inputs.push_back({tick, thrust, 30});
    }
    world.step();
  }
  if (end != nullptr) *end = *world.find(5);
  return drive;
}

}  // namespace

TEST_CASE("a ghost drives to the bit where the drive went, forth and back") {
  const auto map = map_of("volcano");
  state::Louse end;
  GhostRun run(*map, 60, state::Mode::kRoam, driven(*map, 8, &end));
  const auto at_end = run.at(480.0);
  REQUIRE(at_end);
  CHECK(at_end->position == end.position);
  CHECK_FALSE(run.at(481.0));
  CHECK(run.at(0.0)->position == louse_on(*map).position);
  CHECK(run.at(480.0)->position == end.position);
}

TEST_CASE("drives come back from their text as they were, and what is none is passed over") {
  const auto map = map_of("volcano");
  const std::vector<OwnDrive> drives{driven(*map, 4), driven(*map, 6)};
  const std::string text = ghost_drives_text(drives, 60, state::Mode::kRoam);
  const auto read = parse_ghost_drives(text, *map, 60, state::Mode::kRoam);
  REQUIRE(read.size() == 2);
  CHECK(read[1].ticks == 360);
  CHECK(read[1].inputs == drives[1].inputs);
  CHECK(read[0].start.position == drives[0].start.position);
  CHECK(parse_ghost_drives(text, *map, 30, state::Mode::kRoam).empty());  // another rate
  CHECK(parse_ghost_drives(text, *map, 60, state::Mode::kRace).empty());
  for (std::size_t cut = 0; cut < text.size(); cut += 37)  // a file that was cut off
    CHECK(parse_ghost_drives(text.substr(0, cut), *map, 60, state::Mode::kRoam).size() <= 1);
  for (const char* bad : {"\n", "{}\n{}\n", "null", "{\"type\":\"ack\"}\n{\"type\":\"ghost\"}\n"})
    CHECK(parse_ghost_drives(bad, *map, 60, state::Mode::kRoam).empty());
}

TEST_CASE("a drive that no louse can drive is refused") {
  const auto map = map_of("volcano");
  const OwnDrive good = driven(*map, 4);
  CHECK(why_no_drive(*map, 60, good).empty());
  const auto refused = [&](auto change) {
    OwnDrive bad = good;
    change(bad);
    CHECK_FALSE(why_no_drive(*map, 60, bad).empty());
    // Not by its text, either: some of it is not even written so that it can be read.
    CHECK(parse_ghost_drives(ghost_drives_text({bad}, 60, state::Mode::kRoam), *map, 60, state::Mode::kRoam)
              .empty());
  };
  refused([](OwnDrive& d) { d.start.position.x = 1e6; });
  refused([](OwnDrive& d) { d.start.velocity.x = 1e300; });
  refused([](OwnDrive& d) { d.start.heading = {}; });
  refused([](OwnDrive& d) { d.start.phase = state::Phase::kFlying; });
  refused([](OwnDrive& d) { d.ticks = 0; });
  refused([](OwnDrive& d) { d.inputs[1].at = 0; });
  refused([](OwnDrive& d) { d.inputs[0].thrust.value = {3.0, 0.0}; });
}

TEST_CASE("own drives are kept in a file of twenty at most, and are there again") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("woodlouse-ghosts-" + std::to_string(getpid()));
  const auto map = map_of("volcano");
  {
    Ghosts ghosts;
    ghosts.keep_in(folder);
    ghosts.begin(map, 60, state::Mode::kRoam);
    CHECK(ghosts.marks(0.0, 0, 0.0).empty());
    for (int i = 0; i < 23; ++i) ghosts.add_drive(driven(*map, 4));
    CHECK(ghosts.marks(0.0, 0, 0.0).size() == 1);
  }
  Ghosts ghosts;
  ghosts.keep_in(folder);
  ghosts.begin(map, 60, state::Mode::kRoam);
  CHECK(ghosts.marks(60.0, 0, 0.0).size() == 1);
  CHECK(read_ghost_drives(folder, *map, 60, state::Mode::kRoam).size() == kMostGhostsKept);
  ghosts.cycle();
  CHECK(ghosts.marks(60.0, 0, 0.0)[0].name == "your last");
  ghosts.cycle();
  CHECK(ghosts.marks(60.0, 0, 0.0).empty());
  std::filesystem::remove_all(folder);
}

TEST_CASE("of a race's drives the best is one with a lap, whatever came first") {
  const auto map = map_of("crater_loop");
  Ghosts ghosts;
  ghosts.begin(map, 60, state::Mode::kRace);
  ghosts.add_drive(driven(*map, 4));
  CHECK(ghosts.marks(0.0, 0, 0.0).empty());
  OwnDrive slow = driven(*map, 5), quick = driven(*map, 6), none = driven(*map, 7);
  slow.lap = 90 * 60 * 65536ULL;
  quick.lap = 30 * 60 * 65536ULL;
  for (OwnDrive* drive : {&slow, &quick, &none}) ghosts.add_drive(*drive);
  REQUIRE(ghosts.marks(0.0, 0, 0.0).size() == 1);
  CHECK(ghosts.marks(0.0, 0, 0.0)[0].name == "your best");
  CHECK(ghosts.marks(5.5 * 60, 0, 0.0).size() == 1);  // the quick one goes on for six seconds
  CHECK(ghosts.marks(6.5 * 60, 0, 0.0).empty());
  ghosts.cycle();
  REQUIRE(ghosts.marks(0.0, 0, 0.0).size() == 1);
  CHECK(ghosts.marks(0.0, 0, 0.0)[0].name == "your last");
}

TEST_CASE("two clients of one account lose none of each other's drives, of other rates neither") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("woodlouse-two-clients-" + std::to_string(getpid()));
  const auto map = map_of("volcano");
  Ghosts one, other;
  for (Ghosts* ghosts : {&one, &other}) {
    ghosts->keep_in(folder);
    ghosts->begin(map, 60, state::Mode::kRoam);
  }
  one.add_drive(driven(*map, 4));
  other.add_drive(driven(*map, 5));
  one.add_drive(driven(*map, 6));
  CHECK(keep_ghost_drives(folder, *map, 30, state::Mode::kRoam, {driven(*map, 4)}));
  std::vector<std::uint32_t> ticks;
  for (const OwnDrive& drive : read_ghost_drives(folder, *map, 60, state::Mode::kRoam))
    ticks.push_back(drive.ticks);
  CHECK(ticks == std::vector<std::uint32_t>{240, 300, 360});
  CHECK(read_ghost_drives(folder, *map, 30, state::Mode::kRoam).size() == 1);

  // At the same time, from processes of their own.
  std::filesystem::remove_all(folder);
  constexpr int kClients = 4;
  for (int i = 0; i < kClients; ++i)
    if (fork() == 0) {
      for (int k = 0; k < 4; ++k)
        while (!keep_ghost_drives(folder, *map, 60, state::Mode::kRoam, {driven(*map, 4)})) {
        }
      _exit(0);
    }
  for (int i = 0; i < kClients; ++i) {
    int status = 1;
    REQUIRE(wait(&status) > 0);
    CHECK(status == 0);
  }
  CHECK(read_ghost_drives(folder, *map, 60, state::Mode::kRoam).size() == 16);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "ghosts"))
    files += entry.is_regular_file() ? 1 : 0;
  CHECK(files == 1);  // nothing half written is left behind
  std::filesystem::remove_all(folder);
}

TEST_CASE("a drive that can't be kept for another client's sake, or the disk's, is kept later") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("woodlouse-held-" + std::to_string(getpid()));
  const auto map = map_of("volcano");
  const auto kept = [&] { return read_ghost_drives(folder, *map, 60, state::Mode::kRoam).size(); };
  {
    Ghosts ghosts;
    ghosts.keep_in(folder);
    ghosts.begin(map, 60, state::Mode::kRoam);
    ghosts.add_drive(driven(*map, 4));
    CHECK(kept() == 1);

    const int held = open((folder / "ghosts").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    REQUIRE(flock(held, LOCK_EX) == 0);
    ghosts.add_drive(driven(*map, 5));
    CHECK(kept() == 1);
    close(held);
    ghosts.add_drive(driven(*map, 6));
    CHECK(kept() == 3);

    // A file that can't be read now is not written over.
    const auto file = std::filesystem::directory_iterator(folder / "ghosts")->path();
    const std::filesystem::path away = folder / "away";
    std::filesystem::rename(file, away);
    std::filesystem::create_directory(file);
    ghosts.add_drive(driven(*map, 7));
    std::filesystem::remove(file);
    std::filesystem::rename(away, file);
    CHECK(kept() == 3);
  }
  CHECK(kept() == 4);  // the game is over: the last try
  std::filesystem::remove_all(folder);
}

TEST_CASE("a drive behind a damaged end of the file is kept") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("woodlouse-damaged-" + std::to_string(getpid()));
  const auto map = map_of("volcano");
  CHECK(keep_ghost_drives(folder, *map, 60, state::Mode::kRoam, {driven(*map, 4)}));
  for (const auto& entry : std::filesystem::directory_iterator(folder / "ghosts"))
    std::ofstream(entry.path(), std::ios::app) << "{\"type\":\"ack\"";
  CHECK(keep_ghost_drives(folder, *map, 60, state::Mode::kRoam, {driven(*map, 5)}));
  CHECK(read_ghost_drives(folder, *map, 60, state::Mode::kRoam).size() == 2);
  std::filesystem::remove_all(folder);
}

TEST_CASE("a run that is on two boards and the author's, too, is one ghost") {
  const auto map = map_of("crater_loop");
  auto line = *read_author_ghost(*map, 60);
  Ghosts ghosts;
  ghosts.keep_in("/nowhere");
  ghosts.begin(map, 60, state::Mode::kRace);
  REQUIRE(ghosts.marks(std::nullopt, 0, 0.0).size() == 1);
  line.run.name = "ada";
  for (const protocol::Board board : {protocol::Board::kPeople, protocol::Board::kBots}) {
    line.run.board = board;
    REQUIRE(ghosts.add_record(line));
    const auto marks = ghosts.marks(std::nullopt, 0, 0.0);
    REQUIRE(marks.size() == 1);
    CHECK(marks[0].name.starts_with("ada "));
  }
  line.ghost.inputs.pop_back();  // another run
  REQUIRE(ghosts.add_record(line));
  CHECK(ghosts.marks(std::nullopt, 0, 0.0).size() == 2);
}

TEST_CASE("a record's ghost is raced from the first gate on, and one that can't be driven here is none") {
  const auto map = map_of("crater_loop");
  std::ifstream file(map::find_map("crater_loop")->parent_path() / "ghosts" / "crater_loop.json");
  std::ostringstream text;
  text << file.rdbuf();
  const auto message = protocol::decode_server(text.str(), {}, protocol::Format::kExact);
  REQUIRE(message);
  auto line = std::get<protocol::GhostLine>(*message);
  Ghosts ghosts;
  ghosts.begin(map, 60, state::Mode::kRace);
  REQUIRE(ghosts.add_record(line));
  const auto waits = ghosts.marks(std::nullopt, 0, 5000.0);  // the own clock does not run
  REQUIRE(waits.size() == 1);
  CHECK(waits[0].name == "Dash 2 1:01.651");
  CHECK(std::hypot(waits[0].position.x, waits[0].position.y) < 4.0);  // at gate S
  const auto runs = ghosts.marks(std::nullopt, 5000 * 65536LL, 5300.0);
  CHECK(runs.at(0).position != waits[0].position);
  line.behavior += 1;
  CHECK_FALSE(ghosts.add_record(line));
  line.behavior -= 1;
  line.ghost.spawn = 1000;
  CHECK_FALSE(ghosts.add_record(line));
}

TEST_CASE(
    "a shipped race has its author's ghost where files may be read, and a server's word names no file") {
  const auto map = map_of("crater_loop");
  REQUIRE(read_author_ghost(*map, 60));
  CHECK_FALSE(read_author_ghost(*map, 30));  // another rate
  map::Map renamed = *map;
  for (const char* name : {"../maps/crater_loop", "/etc/passwd", "figure_eight", ""}) {
    renamed.definition.name = name;
    CHECK_FALSE(read_author_ghost(renamed, 60));
  }
  Ghosts ghosts;
  ghosts.keep_in("/nowhere");
  ghosts.begin(map, 60, state::Mode::kRace);
  REQUIRE(ghosts.marks(std::nullopt, 0, 0.0).size() == 1);
  CHECK(ghosts.marks(std::nullopt, 0, 0.0)[0].name.starts_with("author 1:01"));
}
