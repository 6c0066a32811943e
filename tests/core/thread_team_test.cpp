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
    for (int round = 0; round < 40; ++round) {
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

TEST_CASE("the members of a team work at once") {
  ThreadTeam team(3);
  std::atomic<std::size_t> there{0};
  std::mutex mutex;
  std::set<std::thread::id> members;
  // Each part waits until three are in one: no two of them can be done by the same thread.
  REQUIRE(team.try_run(3, [&](std::size_t) {
    ++there;
    while (there < 3) std::this_thread::yield();
    const std::lock_guard lock(mutex);
    members.insert(std::this_thread::get_id());
  }));
  CHECK(members.size() == 3);
  CHECK(members.count(std::this_thread::get_id()) == 1);
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

TEST_CASE("work is cut where each part is worth it, and no finer than the team has use of") {
  const ThreadTeam alone(1, Cut::kFinest), team(2), finest(2, Cut::kFinest);
  CHECK(alone.parts(100000, 1) == 1);
  CHECK(team.parts(0, 500) == 1);
  CHECK(team.parts(999, 500) == 1);
  CHECK(team.parts(1000, 500) == 2);
  CHECK(team.parts(100000, 500) == 2 * Team::kPartsEach);
  CHECK(finest.parts(0, 500) == 1);
  CHECK(finest.parts(3, 500) == 3);
  CHECK(finest.parts(100000, 500) == 2 * Team::kPartsEach);
  CHECK(woodlouse::core::parts_for(nullptr, 100000, 1) == 1);
}
