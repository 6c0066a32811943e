#include "server/watchers/job_thread.h"

#include <atomic>
#include <future>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

using namespace woodlouse::server;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

Time soon() { return Clock::now() + seconds(20); }

}  // namespace

TEST_CASE("jobs are done in their order, the last one last, then the thread tends once more and ends") {
  std::vector<int> done;
  JobThread thread(1000, seconds(20), [&done] { done.push_back(-1); });
  for (int job = 0; job < 100; ++job) REQUIRE(thread.post([&done, job] { done.push_back(job); }));
  thread.post_last([&done] { done.push_back(100); });
  CHECK_FALSE(thread.post([&done] { done.push_back(101); }));
  REQUIRE(thread.wait_until(soon()));
  REQUIRE(done.size() == 102);
  for (int job = 0; job <= 100; ++job) CHECK(done[static_cast<std::size_t>(job)] == job);
  CHECK(done[101] == -1);
}

TEST_CASE("what was done is tended to soon, whether more comes or not") {
  std::atomic<int> tended = 0;
  JobThread thread(1000, milliseconds(5), [&tended] { ++tended; });
  REQUIRE(thread.post([] {}));
  while (tended == 0) std::this_thread::sleep_for(milliseconds(1));
  for (const Time end = Clock::now() + milliseconds(50); Clock::now() < end;)
    if (!thread.post([] {})) std::this_thread::sleep_for(milliseconds(1));
  CHECK(tended > 2);
  thread.close();
  REQUIRE(thread.wait_until(soon()));
}

TEST_CASE("a thread that stands still takes no more than its queue holds, and nobody waits for it") {
  std::promise<void> goes_on;
  std::promise<void> stands;
  auto held = std::make_shared<int>(0);  // what jobs use lives as long as they do
  std::weak_ptr<int> seen = held;
  auto thread = std::make_unique<JobThread>(3, seconds(20), [] {});
  REQUIRE(thread->post([&stands, until = goes_on.get_future().share(), held = std::move(held)] {
    stands.set_value();
    until.wait();
  }));
  stands.get_future().wait();
  for (int job = 0; job < 3; ++job) CHECK(thread->post([] {}));
  CHECK_FALSE(thread->post([] {}));
  thread->post_last([] {});
  CHECK_FALSE(thread->wait_until(Clock::now() + milliseconds(10)));
  thread.reset();
  CHECK_FALSE(seen.expired());
  goes_on.set_value();
  for (const Time end = soon(); !seen.expired() && Clock::now() < end;)
    std::this_thread::sleep_for(milliseconds(1));
  CHECK(seen.expired());
}
