#include "bench/swarm/frame_scan.h"

#include <catch2/catch.hpp>
#include <limits>
#include <string>

using woodlouse::swarm::scan_frame_tick;

namespace {

std::string frame(const std::string& type, const std::string& tick) {
  return R"({"type":")" + type + R"(","tick":)" + tick + R"(,"louse":[[1,2,3]]})";
}

}  // namespace

TEST_CASE("keys and deltas give their tick, whatever its size") {
  for (const std::uint64_t tick : {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{1} << 53,
                                   std::numeric_limits<std::uint64_t>::max()}) {
    CHECK(scan_frame_tick(frame("key", std::to_string(tick))) == tick);
    CHECK(scan_frame_tick(frame("delta", std::to_string(tick))) == tick);
  }
}

TEST_CASE("other messages give none, even those with a tick") {
  for (const std::string line :
       {"", "{}", R"({"type":"ping","t":5})", R"({"type":"ack","seq":1,"tick":5,"late":false})",
        R"({"tick":5,"type":"key","louse":[]})", R"({"type":"keys","tick":5,"louse":[]})"}) {
    INFO(line);
    CHECK_FALSE(scan_frame_tick(line));
  }
}

TEST_CASE("a tick that is no whole number of 64 bits gives none") {
  for (const std::string tick : {"", "-1", "1.5", "1e3", "\"5\"", "18446744073709551616"}) {
    INFO(tick);
    CHECK_FALSE(scan_frame_tick(frame("delta", tick)));
  }
}

TEST_CASE("a frame that was cut anywhere gives none") {
  const std::string whole = frame("delta", "840");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    INFO(whole.substr(0, size));
    CHECK_FALSE(scan_frame_tick(std::string_view(whole).substr(0, size)));
  }
}
