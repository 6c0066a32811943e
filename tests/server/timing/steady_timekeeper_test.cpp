#include "server/timing/steady_timekeeper.h"

#include <boost/asio/io_context.hpp>
#include <catch2/catch.hpp>

#include <vector>

using namespace woodlouse::server;
using std::chrono::hours;
using std::chrono::milliseconds;

TEST_CASE("a steady alarm rings once, not before its time") {
  boost::asio::io_context io{1};
  SteadyTimekeeper timekeeper;
  const auto alarm = timekeeper.make_alarm(io.get_executor());
  const Time until = timekeeper.now() + milliseconds(5);
  Time rang{};
  int rings = 0;
  alarm->set(until, [&](bool cancelled) {
    CHECK_FALSE(cancelled);
    rang = timekeeper.now();
    ++rings;
  });
  io.run();
  CHECK(rings == 1);
  CHECK(rang >= until);
}

TEST_CASE("a steady alarm set again or cancelled tells who waited for it") {
  boost::asio::io_context io{1};
  SteadyTimekeeper timekeeper;
  auto alarm = timekeeper.make_alarm(io.get_executor());
  std::vector<std::pair<int, bool>> calls;
  const auto set = [&](int name, Duration wait) {
    alarm->set(timekeeper.now() + wait,
               [&calls, name](bool cancelled) { calls.emplace_back(name, cancelled); });
  };
  set(1, hours(1));
  set(2, hours(1));
  alarm->cancel();
  set(3, hours(1));
  alarm.reset();
  CHECK(calls.empty());
  io.run();
  CHECK(calls == std::vector<std::pair<int, bool>>{{1, true}, {2, true}, {3, true}});
}
