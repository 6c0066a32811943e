#include "server/cluster/join_code.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace woodlouse::server::join_code_test {

namespace {

std::string code(const std::string& cluster, const RoomName& room) {
  return join_codes(cluster, {room}).front();
}

}  // namespace

TEST_CASE("a code is five letters that follow from the names, today as tomorrow") {
  // A promise: hosts of other builds tell the same.
  CHECK(code("woodlouse", {"main", "volcano"}) == "RRRSB");
  CHECK(code("", {"", "volcano"}) == "VKVZJ");
  CHECK(code("woodlouse", {"main", "volcano"}) != code("woodlice", {"main", "volcano"}));
  CHECK(code("woodlouse", {"main", "volcano"}) != code("woodlouse", {"other", "volcano"}));
  CHECK(code("a", {"b", "c"}) != code("ab", {"", "c"}));
}

TEST_CASE("what somebody types is a code in capitals or not, and a name is none") {
  CHECK(typed_join_code("bcdfg") == "BCDFG");
  CHECK(typed_join_code("BcDfX") == "BCDFX");
  for (const auto* no : {"", "bcdf", "bcdfgh", "bcdfa", "bcdf1", "bcdfl", "hills", "bcd g", "bcdf\xc3"})
    CHECK_FALSE(typed_join_code(no));
  CHECK(typed_join_code(code("woodlouse", {"main", "volcano"})) == code("woodlouse", {"main", "volcano"}));
}

TEST_CASE("of two rooms with one code the first by name keeps it, whatever order they are told in") {
  // Of so many some do meet.
  constexpr int kRooms = 4000;
  std::vector<RoomName> rooms;
  std::map<std::string, std::vector<RoomName>> alone;
  for (int k = 0; k < kRooms; ++k) {
    rooms.push_back({"main", "room " + std::to_string(k)});
    alone[code("c", rooms.back())].push_back(rooms.back());
  }
  const std::vector<std::string> codes = join_codes("c", rooms);
  CHECK(std::set<std::string>(codes.begin(), codes.end()).size() == rooms.size());
  std::map<RoomName, std::string> of;
  for (std::size_t k = 0; k < rooms.size(); ++k) of[rooms[k]] = codes[k];
  int met = 0;
  for (auto& [letters, names] : alone) {
    std::sort(names.begin(), names.end());
    met += names.size() > 1 ? 1 : 0;
    if (names.size() > 1) CHECK(of[names.back()] != letters);
  }
  CHECK(met > 0);

  std::vector<RoomName> reversed(rooms.rbegin(), rooms.rend());
  std::vector<std::string> again = join_codes("c", reversed);
  std::reverse(again.begin(), again.end());
  CHECK(again == codes);
}

}  // namespace woodlouse::server::join_code_test
