#include "server/records/board_rows.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using protocol::Board;

namespace {

Row row_of(const std::string& name, std::uint64_t time, state::Role role = state::Role::kPlayer,
           Board board = Board::kPeople) {
  return {{board, name, role, time, {time}, 0}, Line(name + "\n")};
}

std::vector<std::uint64_t> times_on(const BoardRows& rows, Board board = Board::kPeople) {
  std::vector<std::uint64_t> times;
  for (const Row& row : rows.of(board)) times.push_back(row.run.time);
  return times;
}

}  // namespace

TEST_CASE("rows stand best first, one a name and role, of equal times the earlier first") {
  BoardRows rows;
  CHECK(rows.take(row_of("a", 50)) == 1);
  CHECK(rows.take(row_of("b", 40)) == 1);
  CHECK(rows.take(row_of("c", 50)) == 3);
  CHECK(rows.take(row_of("a", 60)) == 0);
  CHECK(rows.take(row_of("a", 50)) == 0);
  CHECK(rows.take(row_of("a", 45)) == 2);
  CHECK(times_on(rows) == std::vector<std::uint64_t>{40, 45, 50});
  CHECK(rows.take(row_of("a", 30, state::Role::kBot)) == 1);
  CHECK(rows.take(row_of("a", 70, state::Role::kPlayer, Board::kHandedIn)) == 1);
  CHECK(rows.count() == 5);
  rows.cut(2);
  CHECK(times_on(rows) == std::vector<std::uint64_t>{30, 40});
  CHECK(times_on(rows, Board::kHandedIn) == std::vector<std::uint64_t>{70});
}

TEST_CASE("a board holds a hundred rows, and wants what beats the last") {
  BoardRows rows;
  for (std::uint64_t k = 0; k < 100; ++k) {
    CHECK(rows.wants(Board::kPeople, 1'000'000));
    CHECK(rows.take(row_of("n" + std::to_string(k), 1000 + k)) == k + 1);
  }
  CHECK_FALSE(rows.wants(Board::kPeople, 1099));
  CHECK(rows.wants(Board::kPeople, 1098));
  CHECK(rows.wants(Board::kBots, 1099));
  CHECK(rows.take(row_of("late", 1099)) == 0);
  CHECK(rows.take(row_of("good", 1000)) == 2);
  CHECK(rows.of(Board::kPeople).size() == 100);
  CHECK(rows.of(Board::kPeople).back().run.name == "n98");
}
