#include "server/records/board.h"

#include <catch2/catch.hpp>
#include <vector>

#include "server/records/ghost_recorder.h"
#include "server/records/records.h"
#include "tests/server/records/racing.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;
using namespace std::chrono_literals;

namespace {

struct BoardRoom : BoardsFolder, BoardLog {
  std::shared_ptr<const map::Map> map = ring_map();
  std::vector<protocol::Event> events;
  std::shared_ptr<server::Board> board = open();

  [[nodiscard]] std::shared_ptr<server::Board> open() const {
    auto opened = server::Board::open(path, map, 60, "ring.json", log);
    if (!opened) FAIL(opened.error().text());
    return std::move(*opened);
  }
  void offer(match::DrivenRun driven, const std::string& name, state::Role role = state::Role::kPlayer) {
    CHECK(board->offer({std::move(driven), name, role, 7, "ring/race",
                        [this](const protocol::Event& event) { events.push_back(event); }}));
  }
  void end() { board->end(Clock::now() + 60s); }
  [[nodiscard]] std::string file() const { return BoardsFolder::read(fs::directory_iterator(path)->path()); }
  [[nodiscard]] std::vector<protocol::RecordRow> rows(protocol::Board kind) const {
    const auto message = protocol::decode_server(*board->records(kind), {}, protocol::Format::kExact);
    REQUIRE(message);
    return std::get<protocol::Records>(*message).rows;
  }
};

}  // namespace

TEST_CASE("a run is re-run, shown and written, a new best is told, and people and bots are apart") {
  BoardRoom room;
  const match::DrivenRun slow = ring_run(room.map, 0.5), fast = ring_run(room.map, 0.75);
  room.offer(slow, "mara");
  room.offer(fast, "timo");
  room.offer(slow, "timo");
  room.offer(slow, "robo", state::Role::kBot);
  room.end();
  const auto people = room.rows(protocol::Board::kPeople);
  REQUIRE(people.size() == 2);
  CHECK((people[0].rank == 1 && people[0].run.name == "timo" && people[0].run.time == fast.time));
  CHECK((people[1].run.name == "mara" && people[1].run.when == 7));
  CHECK(room.rows(protocol::Board::kBots).size() == 1);
  REQUIRE(room.events.size() == 3);
  CHECK(room.events[1].kind == protocol::EventKind::kRecord);
  CHECK(room.events[1].values[0] == static_cast<std::int64_t>(fast.time));
  CHECK(room.events[2].values[1] == 1);
  CHECK(room.board->lost().empty());
  CHECK_FALSE(room.board->ghost(protocol::Board::kPeople, 3));
  const auto ghost = read_ghost_line(*room.board->ghost(protocol::Board::kPeople, 1), "ghost");
  REQUIRE(ghost);
  CHECK(ghost->ghost == fast.ghost);
  CHECK(match::why_not_proven(*room.map, 60, ghost->ghost, times_of(*ghost)).empty());

  const BoardLog second;
  auto again = server::Board::open(room.path, room.map, 60, "ring.json", second.log);
  REQUIRE_FALSE(again);  // the file has one writer
  room.board.reset();
}

TEST_CASE("what stands in a file is re-run when it is opened, and shown where it is the same") {
  BoardRoom room;
  room.offer(ring_run(room.map, 0.5), "mara");
  room.end();
  room.board.reset();
  const fs::path file = fs::directory_iterator(room.path)->path();
  protocol::GhostLine altered = ghost_line(ring_run(room.map, 0.75), "timo");
  altered.ghost.inputs[0].thrust.value.x = 1.0;
  BoardsFolder::append(file, protocol::encode(altered) + "{\"type\":");
  const std::string before = room.file();
  room.board = room.open();
  room.end();
  CHECK(room.rows(protocol::Board::kPeople).size() == 1);
  CHECK(room.has("the last line was cut off, 8 bytes"));
  CHECK(room.has(":3: \"timo\"'s run of "));
  CHECK(room.has("gate 0, where the clock starts, is said to be driven through at tick "));
  CHECK(room.file() + "{\"type\":" == before);
}

TEST_CASE("a run that differs from its re-run is refused loudly, one that began between rounds is not") {
  BoardRoom room;
  match::DrivenRun driven = ring_run(room.map, 0.5);
  driven.times.gates[1] += 1;
  room.offer(driven, "mara");
  match::DrivenRun early = ring_run(room.map, 0.5);
  for (rules::Moment& gate : early.times.gates) gate += 600 * rules::kMomentsPerTick;
  early.counted_from = 600;
  room.offer(early, "timo");
  room.end();
  CHECK(room.rows(protocol::Board::kPeople).empty());
  CHECK(room.has("[error] RECORD REFUSED: room ring/race: \"mara\"'s run of "));
  CHECK(room.has("gate 1, in lap 1, is said to be driven through at tick "));
  CHECK(room.has("[info] room ring/race: \"timo\"'s run of "));
}

TEST_CASE("what better runs replaced is rewritten away when it is more than all else") {
  BoardRoom room;
  match::DrivenRun driven = ring_run(room.map, 0.25);
  const match::DrivenRun best = ring_run(room.map, 1.0);
  // Inputs that change nothing make lines long.
  for (std::uint32_t k = 0; k < 15'000; ++k) driven.ghost.inputs.push_back({driven.ghost.ticks - 1, {}, 1});
  CHECK(match::why_not_proven(*room.map, 60, driven.ghost, driven.times).empty());
  for (int k = 0; k < 24; ++k) {
    driven.ghost.inputs.pop_back();
    room.offer(driven, "mara" + std::to_string(k));
  }
  room.end();
  const std::size_t full = room.file().size();
  CHECK(full > server::Board::kSpareBytes);
  room.board.reset();
  room.board = room.open();
  for (int k = 0; k < 24; ++k) room.offer(best, "mara" + std::to_string(k));
  room.end();
  CHECK(room.file().size() < full / 2);
  CHECK(room.rows(protocol::Board::kPeople).size() == protocol::kMostRecordsShown);
}

TEST_CASE("rooms of one course share a board, whatever their map is called") {
  const BoardsFolder folder;
  const BoardLog told;
  Records records(folder.path / "new" / "records", told.log);
  const match::Match one(ring_map(), {60, 1, state::Mode::kRace});
  const match::Match two(ring_map(R"("laps":1,"round_s":9)", "twin"), {60, 2, state::Mode::kRace});
  const match::Match other(ring_map(R"("laps":2)"), {60, 1, state::Mode::kRace});
  CHECK(records.open("a", one, "a.json"));
  CHECK(records.open("b", two, "b.json"));
  CHECK(records.open("c", other, "c.json"));
  CHECK(std::distance(fs::directory_iterator(folder.path / "new" / "records"), {}) == 2);
  records.end(Clock::now() + 60s);
  CHECK(records.lost().empty());
  Records elsewhere("/proc/none", told.log);
  CHECK(elsewhere.open("a", one, "a.json").error().where == "--records /proc/none");
}
