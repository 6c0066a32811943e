#include "shared/state/state_hash.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <string>
#include <vector>

using namespace woodlouse;
using namespace woodlouse::state;

namespace {

std::uint64_t hash(const state::HashLink& link, const std::vector<state::Louse>& lice) {
  core::StableHasher hasher;
  return state::state_hash(hasher, link, lice);
}

}  // namespace

TEST_CASE("the state hash is XXH64 over the documented bytes") {
  const std::vector<state::Louse> lice(3);
  const state::HashLink link{1, 2, 3, 4};
  std::string bytes;
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(link.previous);
  add(link.inputs);
  add(link.tick);
  for (const state::Louse& louse : lice) add(louse);
  add(link.generator);
  REQUIRE(bytes.size() == 32 + 3 * 104);
  CHECK(hash(link, lice) == core::stable_hash(bytes));
}

TEST_CASE("every byte of a louse and of the link shows in the state hash") {
  std::vector<state::Louse> lice(1);
  const state::HashLink link{1, 2, 3, 4};
  const std::uint64_t original = hash(link, lice);
  for (std::size_t i = 0; i < sizeof(state::Louse); ++i) {
    std::vector<state::Louse> altered = lice;
    reinterpret_cast<unsigned char*>(altered.data())[i] ^= 1;
    CHECK(hash(link, altered) != original);
  }
  CHECK(hash({0, 2, 3, 4}, lice) != original);
  CHECK(hash({1, 0, 3, 4}, lice) != original);
  CHECK(hash({1, 2, 0, 4}, lice) != original);
  CHECK(hash({1, 2, 3, 0}, lice) != original);
}
