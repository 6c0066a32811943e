#include "shared/core/thread_team.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

using woodlouse::core::Cut;
using woodlouse::core::Team;
using woodlouse::core::ThreadTeam;

TEST_CASE("a team does each part once and sees what was written before, job after job") {
  for (const std::size_t size : {1u, 2u, 3u, 5u, 64u}) {
    ThreadTeam team(size);
    // Not atomic: a part that two did, or that was not done when the team was, is a race.
    std::vector<std::size_t> done(41, 0);
    std::size_t jobs = 0;
    for (int round = 0; round < 20; ++round) {
      for (std::size_t parts = 1; parts <= done.size(); ++parts) {
        ++jobs;
        REQUIRE(team.try_run(parts, [&](std::size_t part) { done[part] += jobs; }));
        for (std::size_t part = 0; part < done.size(); ++part) {
          REQUIRE(done[part] == (part < parts ? jobs : 0));
          done[part] = 0;
        }
      }
    }
  }
}

TEST_CASE("the members of a team work at once, as many as there is work for") {
  ThreadTeam team(5);
  for (const std::size_t wanted : {2u, 3u, 5u}) {
    const std::size_t parts = wanted == 2 ? 2 : Team::kPartsEach * wanted;
    REQUIRE(team.members(parts) == wanted);
    for (int round = 0; round < 20; ++round) {
      std::atomic<std::size_t> there{0};
      std::mutex mutex;
      std::set<std::thread::id> members;
      // The first parts wait until so many are in one, so that no thread does two of them.
      REQUIRE(team.try_run(parts, [&](std::size_t) {
        ++there;
        while (there < wanted) std::this_thread::yield();
        const std::lock_guard lock(mutex);
        members.insert(std::this_thread::get_id());
      }));
      REQUIRE(members.size() == wanted);
      REQUIRE(members.count(std::this_thread::get_id()) == 1);
    }
  }
}

TEST_CASE("a team that is at another's work is not waited for") {
  ThreadTeam team(2);
  std::atomic<bool> is_taken{false}, may_end{false};
  std::thread other([&] {
    const bool was_free = team.try_run(2, [&](std::size_t) {
      is_taken = true;
      while (!may_end) std::this_thread::yield();
    });
    may_end = !was_free || may_end;
  });
  while (!is_taken) std::this_thread::yield();
  // The other's work can't end before this does.
  CHECK_FALSE(team.try_run(2, [](std::size_t) { FAIL("called"); }));
  std::vector<std::size_t> here;
  woodlouse::core::run_parts(&team, 3, [&](std::size_t part) { here.push_back(part); });
  CHECK(here == std::vector<std::size_t>{0, 1, 2});
  may_end = true;
  other.join();
  CHECK(team.try_run(2, [](std::size_t) {}));
}

TEST_CASE("several callers share a team, and each has all of its parts done") {
  ThreadTeam team(3);
  std::vector<std::thread> callers;
  std::atomic<std::size_t> wrong{0};
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&] {
      std::vector<std::size_t> done(7, 0);
      for (std::size_t job = 1; job <= 500; ++job) {
        woodlouse::core::run_parts(&team, done.size(), [&](std::size_t part) { done[part] += part + 1; });
        for (std::size_t part = 0; part < done.size(); ++part) wrong += done[part] != job * (part + 1);
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  CHECK(wrong == 0);
}

TEST_CASE("work is cut where it is worth it, for as many members as have enough of it") {
  const ThreadTeam alone(1, Cut::kFinest), team(3), finest(3, Cut::kFinest);
  CHECK(alone.parts(100000, 1) == 1);
  CHECK(team.parts(0, 500) == 1);
  CHECK(team.parts(999, 500) == 1);
  CHECK(team.parts(1000, 500) == 2 * Team::kPartsEach);
  CHECK(team.parts(1499, 500) == 2 * Team::kPartsEach);
  CHECK(team.parts(100000, 500) == 3 * Team::kPartsEach);
  CHECK(team.parts(2, 1) == 2);
  CHECK(finest.parts(0, 500) == 1);
  CHECK(finest.parts(1, 500) == 1);
  CHECK(finest.parts(5, 500) == 5);
  CHECK(finest.parts(100000, 500) == 3 * Team::kPartsEach);
  CHECK(team.members(1) == 1);
  CHECK(team.members(2) == 2);
  CHECK(team.members(2 * Team::kPartsEach) == 2);
  CHECK(team.members(100) == 3);
  CHECK(woodlouse::core::parts_for(nullptr, 100000, 1) == 1);
}
