#include "shared/state/state_hash.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "shared/core/thread_team.h"

using namespace woodlouse;
using namespace woodlouse::state;

namespace {

std::uint64_t hash(const state::HashLink& link, const std::vector<state::Louse>& lice) {
  core::StableHasher hasher;
  return state::state_hash(hasher, link, lice);
}

}  // namespace

/// Those of them, one after the other.
std::string bytes_of(std::span<const state::Louse> lice) {
  return {reinterpret_cast<const char*>(lice.data()), lice.size_bytes()};
}

std::vector<state::Louse> numbered(std::size_t count) {
  std::vector<state::Louse> lice(count);
  for (std::size_t k = 0; k < count; ++k) lice[k].id = static_cast<state::LouseId>(k + 1);
  return lice;
}

TEST_CASE("the state hash is XXH64 over the link's words and one word a block of 64 lice") {
  const state::HashLink link{1, 2, 3, 4, 5, 6};
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 128u, 200u}) {
    const std::vector<state::Louse> lice = numbered(count);
    std::vector<std::uint64_t> words{1, 2, 3, 4, 5, 6};
    for (std::size_t first = 0; first < count; first += 64) {
      const std::size_t size = std::min<std::size_t>(64, count - first);
      words.push_back(core::stable_hash(bytes_of(std::span(lice).subspan(first, size))));
    }
    CHECK(hash(link, lice) ==
          core::stable_hash({reinterpret_cast<const char*>(words.data()), 8 * words.size()}));
  }
}

TEST_CASE("blocks that nobody marks keep their value, and only another value counts as a change") {
  std::vector<state::Louse> lice = numbered(130);
  state::BlockHashes kept;
  CHECK(kept.update(lice, std::vector<std::uint8_t>{1, 1, 1}));
  const std::vector<std::uint64_t> before(kept.values().begin(), kept.values().end());
  CHECK_FALSE(kept.update(lice, std::vector<std::uint8_t>{1, 1, 1}));
  lice[70].position.x = 1.0;
  CHECK_FALSE(kept.update(lice, std::vector<std::uint8_t>{1, 0, 1}));
  CHECK(kept.update(lice, std::vector<std::uint8_t>{0, 1, 0}));
  CHECK(kept.values()[0] == before[0]);
  CHECK(kept.values()[1] != before[1]);
  CHECK(kept.values()[2] == before[2]);
  lice.resize(128);
  CHECK(kept.update(lice, std::vector<std::uint8_t>{0, 0}));
  CHECK_FALSE(kept.update(lice, std::vector<std::uint8_t>{0, 0}));
}

TEST_CASE("every byte of a louse and of the link shows in the state hash") {
  std::vector<state::Louse> lice(1);
  const state::HashLink link{1, 2, 3, 4, 5, 6};
  const std::uint64_t original = hash(link, lice);
  for (std::size_t i = 0; i < sizeof(state::Louse); ++i) {
    std::vector<state::Louse> altered = lice;
    reinterpret_cast<unsigned char*>(altered.data())[i] ^= 1;
    CHECK(hash(link, altered) != original);
  }
  CHECK(hash({0, 2, 3, 4, 5, 6}, lice) != original);
  CHECK(hash({1, 0, 3, 4, 5, 6}, lice) != original);
  CHECK(hash({1, 2, 0, 4, 5, 6}, lice) != original);
  CHECK(hash({1, 2, 3, 0, 5, 6}, lice) != original);
  CHECK(hash({1, 2, 3, 4, 0, 6}, lice) != original);
  CHECK(hash({1, 2, 3, 4, 5, 0}, lice) != original);
}

TEST_CASE("a team gives the words and the verdict of one thread, whichever blocks changed") {
  for (const std::size_t size : {1u, 2u, 3u, 5u}) {
    core::ThreadTeam team(size, core::Cut::kFinest);
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 640u, 1281u}) {
      std::vector<state::Louse> lice = numbered(count);
      const std::size_t blocks = block_count(count);
      state::BlockHashes alone, together;
      const auto update = [&](const std::vector<std::uint8_t>& changed) {
        const bool is_another = alone.update(lice, changed);
        REQUIRE(together.update(lice, changed, &team) == is_another);
        REQUIRE(std::equal(alone.values().begin(), alone.values().end(), together.values().begin(),
                           together.values().end()));
        return is_another;
      };
      CHECK(update(std::vector<std::uint8_t>(blocks, 1)) == (count > 0));
      CHECK_FALSE(update(std::vector<std::uint8_t>(blocks, 1)));
      for (std::size_t block = 0; block < blocks; ++block) {
        lice[block * kBlockLice].position.x += 1.0;
        std::vector<std::uint8_t> changed(blocks, 0);
        changed[block] = 1;
        if (block + 1 < blocks) changed[block + 1] = 1;
        CHECK(update(changed));
      }
    }
  }
}
