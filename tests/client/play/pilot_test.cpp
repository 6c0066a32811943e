// The pilot against a server at the far end of a line with latency: no sockets, time counted in milliseconds.
#include "client/play/pilot.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <map>
#include <optional>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

constexpr std::uint32_t kTickHz = 60;

core::Time at(double ms) {
  return core::Time{} + std::chrono::duration_cast<core::Time::duration>(
                            std::chrono::duration<double, std::milli>(1e6 + ms));
}

struct Line {
  double up_ms = 0.0;
  double down_ms = 0.0;
  double jitter_ms = 0.0;
};

struct Report {
  int acks = 0;
  int late = 0;
  double worst_jump = 0.0;  ///< [m] of the drawn louse beyond what its speed explains, after the warm-up
  double way = 0.0;         ///< [m] it went
};

/// Ten seconds of turning and pushing. The first three are warm-up and not judged.
Report drive(const Line& line) {
  auto map = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(map);
  match::Match server(*map, {.tick_hz = kTickHz, .seed = 4});
  const match::PlayerId id = server.join();
  server.advance();
  Pilot pilot(**map, kTickHz, id);
  ServerClock clock(kTickHz);
  core::Random random(1);

  struct Travelling {
    double due;
    protocol::Input input;
  };
  struct Answer {
    double due;
    protocol::Ack ack;
  };
  struct Seen {
    double due;
    std::uint64_t tick;
  };
  std::deque<Travelling> up;
  std::deque<Answer> answers;
  std::deque<Seen> frames;
  std::map<std::uint64_t, protocol::Ack> waiting;
  double last_up = 0.0;
  double last_down = 0.0;
  const auto delayed = [&](double now, double delay, double& last) {
    return last = std::max(last, now + delay + line.jitter_ms * random.uniform());  // TCP keeps the order
  };

  Report report;
  std::optional<LouseSample> before;
  double next_step = 1000.0 / kTickHz;
  for (double now = 0.0; now < 10000.0; now += 1.0) {
    while (!up.empty() && up.front().due <= now) {
      const protocol::Input& input = up.front().input;
      const match::Filed filed = server.file({.player = id,
                                              .seq = input.seq,
                                              .thrust = input.thrust,
                                              .ticks = input.ticks.value_or(state::kHeld),
                                              .wanted_tick = input.tick.value_or(0)});
      REQUIRE(filed.outcome == match::Filed::Outcome::kFiled);
      protocol::Ack ack;
      ack.seq = input.seq;
      ack.tick = filed.tick;
      ack.late = filed.late;
      ack.margin_us = static_cast<std::int64_t>(
          (next_step - now + static_cast<double>(filed.tick - server.tick()) * 1000.0 / kTickHz) * 1e3);
      waiting[filed.tick] = ack;
      up.pop_front();
    }
    if (now >= next_step) {
      const std::uint64_t tick = server.tick();
      server.advance();
      next_step += 1000.0 / kTickHz;
      if (const auto ack = waiting.find(tick); ack != waiting.end()) {
        ack->second.you = protocol::ExactState{tick + 1, *server.world().find(id)};
        answers.push_back({delayed(now, line.down_ms, last_down), ack->second});
        waiting.erase(ack);
      }
      if (server.tick() % 3 == 0) frames.push_back({delayed(now, line.down_ms, last_down), server.tick()});
    }
    for (; !answers.empty() && answers.front().due <= now; answers.pop_front()) {
      pilot.acknowledge(answers.front().ack);
      if (now < 3000.0) continue;
      ++report.acks;
      report.late += answers.front().ack.late ? 1 : 0;
    }
    for (; !frames.empty() && frames.front().due <= now; frames.pop_front())
      clock.observe(frames.front().tick, at(now));

    if (std::fmod(now, 700.0) == 0.0)
      pilot.steering().turn(random.next() % 2 == 0 ? Turn::kLeft : Turn::kRight, at(now));
    if (std::fmod(now, 900.0) == 0.0) pilot.steering().push(at(now));
    if (std::fmod(now, 3100.0) == 0.0) pilot.steering().brake(at(now));
    if (std::fmod(now, 33.0) != 0.0) continue;
    if (const auto input = pilot.update(at(now), clock, (line.up_ms + line.down_ms) * 1e-3)) {
      up.push_back({delayed(now, line.up_ms, last_up), *input});
    }
    const auto sample = pilot.sample();
    if (sample && before && now > 3000.0) {
      const core::Vec2 moved = sample->position - before->position;
      const double speed = std::max(std::hypot(sample->velocity.x, sample->velocity.y),
                                    std::hypot(before->velocity.x, before->velocity.y));
      const double way = std::hypot(moved.x, moved.y);
      report.worst_jump =
          std::max(report.worst_jump, way - 1.06 * speed * 0.033);  // the clock may slew by 5 %
      report.way += way;
    }
    before = sample;
  }
  return report;
}

}  // namespace

TEST_CASE("on a steady line no input comes late and the drawn louse never jumps, at 0, 50 and 150 ms") {
  for (const double rtt : {0.0, 50.0, 150.0, 300.0}) {
    const Report report = drive({.up_ms = rtt * 0.3, .down_ms = rtt * 0.7});
    CAPTURE(rtt, report.worst_jump, report.way);
    REQUIRE(report.acks > 10);
    REQUIRE(report.late == 0);
    REQUIRE(report.way > 5.0);
    REQUIRE(report.worst_jump < 0.01);
  }
}

TEST_CASE("on a jittery line few inputs come late and what that moves is hardly seen") {
  const Report report = drive({.up_ms = 30.0, .down_ms = 40.0, .jitter_ms = 40.0});
  CAPTURE(report.worst_jump, report.late, report.acks);
  REQUIRE(report.late * 4 <= report.acks);
  REQUIRE(report.worst_jump < 0.1);
}

TEST_CASE("whoever begins looks at what is wanted, not where the slope rolls the louse") {
  auto map = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(map);
  Pilot pilot(**map, kTickHz, 1);
  protocol::Ack ack;
  ack.you = protocol::ExactState{10, {}};
  ack.you->louse.id = 1;
  ack.you->louse.position = {3.0, 1.0};
  ack.you->louse.heading = {-1.0, 0.0};
  pilot.look_at({3.0, 9.0});
  pilot.acknowledge(ack);
  CHECK(pilot.steering().heading().y == Approx(1.0));
  pilot.respawned();
  ack.you->louse.position = {5.0, 9.0};
  pilot.acknowledge(ack);
  CHECK(pilot.steering().heading().x == Approx(-1.0));
}
