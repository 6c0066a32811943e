#include "server/records/board_file.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "server/records/course.h"
#include "tests/server/records/racing.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

namespace {

struct BoardStage : BoardsFolder {
  std::shared_ptr<const map::Map> map = ring_map();
  BoardHeader header = header_of(*map, 60, "maps/ring.json");
  fs::path file = path / board_file_name(header.key);

  [[nodiscard]] std::string line(double push, const std::string& name) const {
    return protocol::encode(ghost_line(ring_run(map, push), name));
  }
  [[nodiscard]] std::unique_ptr<BoardFile> open() const {
    auto opened = BoardFile::open(file, header);
    if (!opened) FAIL(opened.error().text());
    return std::move(opened->file);
  }
};

/// A disk that takes so many bytes of a file and no more.
struct FullDisk {
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before);
    rlimit less = before;
    less.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before); }
  rlimit before{};
};

}  // namespace

TEST_CASE("a course's key is that of ground, physics, spawns, gates and laps, rate and behavior alone") {
  const std::uint64_t key = course_key(*ring_map(), 60, 10);
  CHECK(course_key(*ring_map(R"("laps":1,"round_s":20,"podium_s":3,"author_ms":8000)", "other"), 60, 10) ==
        key);
  CHECK(course_key(*ring_map(R"("laps":1,"spawns":[{"position":[-16,1]}])"), 60, 10) == key);
  CHECK(course_key(*ring_map(R"("laps":1,"spawns":[{"position":[-16,2]}])"), 60, 10) != key);
  CHECK(course_key(*ring_map(R"("laps":2)"), 60, 10) != key);
  CHECK(course_key(*ring_map(), 120, 10) != key);
  CHECK(course_key(*ring_map(), 60, 11) != key);
}

TEST_CASE("a board's header reads back, and one of another format or version is refused") {
  const BoardStage stage;
  const std::string line = header_line(stage.header);
  const auto back = read_header_line(line, "board");
  REQUIRE(back);
  CHECK(header_line(*back) == line);
  CHECK(back->definition == stage.map->canonical);
  CHECK_FALSE(read_header_line("{}", "board"));
  std::string later = line;
  later.replace(later.find("\"version\":1"), 11, "\"version\":2");
  CHECK(read_header_line(later, "board").error().what == "is a board of another version");
}

TEST_CASE("rows are appended, and a last line without an end is cut off when the file is opened again") {
  const BoardStage stage;
  const std::string one = stage.line(0.5, "mara"), two = stage.line(0.75, "timo");
  {
    const auto file = stage.open();
    CHECK(file->append(one));
    CHECK_FALSE(BoardFile::open(stage.file, stage.header));  // one writes
    CHECK(read_board(stage.file)->rows.size() == 1);         // anybody reads
  }
  BoardsFolder::append(stage.file, two.substr(0, two.size() / 2));
  CHECK(read_board(stage.file)->torn == two.size() / 2);
  auto opened = BoardFile::open(stage.file, stage.header);
  REQUIRE(opened);
  CHECK(opened->board.torn == two.size() / 2);
  REQUIRE(opened->board.rows.size() == 1);
  CHECK(opened->board.rows[0].text == one);
  CHECK(opened->board.rows[0].line == 2);
  CHECK(opened->file->append(two));
  CHECK(BoardsFolder::read(stage.file) == header_line(stage.header) + one + two);
}

TEST_CASE("a header without an end is written anew, and another course's file is refused") {
  const BoardStage stage;
  BoardsFolder::append(stage.file, "{\"format\":\"wood");
  static_cast<void>(stage.open());
  CHECK(BoardsFolder::read(stage.file) == header_line(stage.header));
  BoardHeader other = stage.header;
  ++other.key;
  const auto refused = BoardFile::open(stage.file, other);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what == "is the board of another course, whatever it is called");
}

TEST_CASE("a line that is no row is named and passed over") {
  const BoardStage stage;
  static_cast<void>(stage.open());
  BoardsFolder::append(stage.file, "{\"type\":\"ghost\"}\nnonsense\n" + stage.line(0.5, "mara"));
  const auto board = read_board(stage.file);
  REQUIRE(board);
  CHECK(board->faults.size() == 2);
  CHECK(board->faults[1].where == stage.file.string() + ":3");
  REQUIRE(board->rows.size() == 1);
  CHECK(board->rows[0].line == 4);
}

TEST_CASE("a full disk leaves whole lines, and the row is written when there is room again") {
  const BoardStage stage;
  const std::string one = stage.line(0.5, "mara"), two = stage.line(0.75, "timo");
  const auto file = stage.open();
  REQUIRE(file->append(one));
  const std::string before = BoardsFolder::read(stage.file);
  {
    const FullDisk full(before.size() + 20);
    CHECK(file->append(two).error().what == "File too large");
    CHECK_FALSE(file->replace({one, two}));
    CHECK(BoardsFolder::read(stage.file) == before);
  }
  CHECK(file->append(two));
  CHECK(BoardsFolder::read(stage.file) == before + two);
  CHECK(std::distance(fs::directory_iterator(stage.path), {}) == 1);
}

TEST_CASE("rows in place of all, and a file that somebody took away or wrote to is not written on") {
  const BoardStage stage;
  const std::string one = stage.line(0.5, "mara"), two = stage.line(0.75, "timo");
  const auto file = stage.open();
  REQUIRE(file->append(one));
  REQUIRE(file->replace({two, one}));
  CHECK(BoardsFolder::read(stage.file) == header_line(stage.header) + two + one);
  CHECK(file->append(one));
  BoardsFolder::append(stage.file, "x");
  CHECK_FALSE(file->append(one));
  REQUIRE(file->replace({two}));
  fs::remove(stage.file);
  CHECK_FALSE(file->append(one));
  CHECK(file->replace({one}));
  CHECK_FALSE(BoardFile::open(stage.file, stage.header));  // the new file is this one's, too
  CHECK(BoardsFolder::read(stage.file) == header_line(stage.header) + one);
}
