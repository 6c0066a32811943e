#include "client/controls/steering.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "client/controls/driving.h"
#include "client/controls/repeat_delay.h"
#include "shared/protocol/codec.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

constexpr std::uint32_t kTickHz = 60;
const core::Time kStart{std::chrono::seconds(100)};

/// What the server would have acting at `now`, from the orders it was sent.
struct Server {
  state::Thrust thrust;
  core::Time until{};

  void take(const std::optional<ThrustOrder>& order, core::Time now) {
    if (!order) return;
    thrust = order->thrust;
    until = now + std::chrono::duration_cast<core::Time::duration>(
                      std::chrono::duration<double>(order->ticks / double{kTickHz}));
  }
  [[nodiscard]] bool pushes(core::Time now) const { return now < until && thrust.value != core::Vec2{}; }
};

}  // namespace

TEST_CASE("a press is one pulse of 0.4 s along the heading") {
  Steering steering(kTickHz);
  steering.point({0.0, 1.0});
  steering.push(kStart);
  const auto order = steering.poll(kStart);
  REQUIRE(order);
  REQUIRE(order->thrust.kind == state::ThrustKind::kMapVector);
  REQUIRE(order->thrust.value == core::Vec2{0.0, 1.0});
  REQUIRE(order->ticks == 24);
  for (auto t = 0ms; t < 2000ms; t += 10ms) REQUIRE_FALSE(steering.poll(kStart + t));
  REQUIRE_FALSE(steering.pushing(kStart + 400ms));
}

TEST_CASE("repeats extend the pulse without a gap and without flooding the server") {
  Steering steering(kTickHz);
  Server server;
  int messages = 0;
  for (auto t = 0ms; t < 3000ms; t += 33ms) {
    const core::Time now = kStart + t;
    steering.push(now);
    const auto order = steering.poll(now);
    messages += order ? 1 : 0;
    server.take(order, now);
    REQUIRE(server.pushes(now));
  }
  REQUIRE(messages < 20);
}

TEST_CASE("cruise pushes without end until it is switched off, which ends it at once") {
  Steering steering(kTickHz);
  Server server;
  steering.toggle_cruise();
  for (auto t = 0ms; t < 5000ms; t += 33ms) {
    server.take(steering.poll(kStart + t), kStart + t);
    REQUIRE(server.pushes(kStart + t));
  }
  steering.toggle_cruise();
  const auto order = steering.poll(kStart + 5000ms);
  REQUIRE(order);
  REQUIRE(order->thrust.value == core::Vec2{});
  REQUIRE_FALSE(steering.poll(kStart + 5033ms));
}

TEST_CASE(
    "a turn while pushing is sent at once, and is a press of its own: the key that pushes repeats no more") {
  Steering steering(kTickHz);
  steering.point({1.0, 0.0});
  steering.push(kStart);
  steering.poll(kStart);
  steering.turn(Turn::kLeft, kStart + 100ms);
  const auto order = steering.poll(kStart + 100ms);
  REQUIRE(order);
  REQUIRE(order->ticks == 24);
  REQUIRE(std::atan2(order->thrust.value.y, order->thrust.value.x) == Approx(0.3927).margin(0.01));
}

TEST_CASE("sixteen turns come back to the first heading, and left undoes right") {
  Steering steering(kTickHz);
  steering.point({0.6, 0.8});
  for (int i = 0; i < 16; ++i) steering.turn(Turn::kRight, kStart);
  REQUIRE(steering.heading().x == Approx(0.6));
  steering.turn(Turn::kLeft, kStart);
  steering.turn(Turn::kRight, kStart);
  REQUIRE(steering.heading().y == Approx(0.8));
}

TEST_CASE("a brake is the number -1 and ends cruise") {
  Steering steering(kTickHz);
  steering.toggle_cruise();
  steering.poll(kStart);
  steering.brake(kStart + 50ms);
  const auto order = steering.poll(kStart + 50ms);
  REQUIRE(order);
  REQUIRE(order->thrust == state::Thrust{state::ThrustKind::kAlongHeading, {-1.0, 0.0}});
  REQUIRE_FALSE(steering.cruising());
}

TEST_CASE("a held push is renewed until its release, which ends it at once") {
  Steering steering(kTickHz);
  Server server;
  steering.hold_push();
  for (auto t = 0ms; t < 2000ms; t += 16ms) {
    server.take(steering.poll(kStart + t), kStart + t);
    REQUIRE(server.pushes(kStart + t));
  }
  steering.release_push();
  server.take(steering.poll(kStart + 2000ms), kStart + 2000ms);
  REQUIRE_FALSE(server.pushes(kStart + 2000ms));
}

TEST_CASE("a client that dies while pushing pushes at most a pulse longer") {
  Steering steering(kTickHz);
  Server server;
  steering.toggle_cruise();
  for (auto t = 0ms; t < 1000ms; t += 33ms) server.take(steering.poll(kStart + t), kStart + t);
  REQUIRE(server.until <= kStart + 1000ms + Steering::kPulse + 17ms);
}

TEST_CASE("a respawn ends every push, and the next one is told anew") {
  Steering steering(kTickHz);
  steering.toggle_cruise();
  steering.poll(kStart);
  steering.reset();
  REQUIRE_FALSE(steering.pushing(kStart));
  REQUIRE_FALSE(steering.poll(kStart));
  steering.push(kStart);
  REQUIRE(steering.poll(kStart));
}

TEST_CASE("a push begun before the louse's heading was known goes on along it") {
  Steering steering(kTickHz);
  steering.toggle_cruise();
  steering.poll(kStart);
  steering.point({0.0, -1.0});
  REQUIRE(steering.poll(kStart + 17ms)->thrust.value == core::Vec2{0.0, -1.0});
}

TEST_CASE("what the wire carries is what the server applies: it neither rounds nor clamps it") {
  for (int i = 0; i < 1000; ++i) {
    const double angle = i * 0.00628;
    protocol::Input input;
    input.seq = 1;
    input.thrust = {state::ThrustKind::kMapVector, wire_vector({std::cos(angle), std::sin(angle)})};
    const auto decoded = protocol::decode_client(protocol::encode(protocol::ClientMessage(input)));
    REQUIRE(decoded);
    const auto& received = std::get<protocol::Input>(*decoded);
    REQUIRE(received.thrust == input.thrust);
    REQUIRE_FALSE(received.clamped);
    REQUIRE(std::hypot(input.thrust.value.x, input.thrust.value.y) > 0.985);
  }
}

TEST_CASE("a held key pushes without a pause, whatever its keyboard waits before it repeats") {
  for (const auto delay : {250ms, 500ms, 660ms, 1000ms}) {
    Steering steering(kTickHz);
    RepeatDelay learnt;
    Server server;
    const Key key{.character = U'w'};
    const auto hold = [&](core::Time begin, bool is_checked) {
      for (auto t = 0ms; t < 2000ms; t += 10ms) {
        const bool comes = t == 0ms || (t >= delay && (t - delay) % 40ms == 0ms);
        if (comes) {
          learnt.observe(key, begin + t);
          steering.set_pulse(learnt.pulse());
          steering.push(begin + t);
        }
        server.take(steering.poll(begin + t), begin + t);
        if (is_checked) REQUIRE(server.pushes(begin + t));
      }
    };
    hold(kStart, false);  // the first time is learnt from
    hold(kStart + 10s, true);
    CHECK(learnt.pulse() == std::max<std::chrono::milliseconds>(400ms, delay + 100ms));
  }
}

TEST_CASE("taps teach nothing: a press is as long as it says") {
  RepeatDelay learnt;
  const Key key{.character = U'w'};
  core::Time at = kStart;
  for (const auto gap : {300ms, 140ms, 90ms, 150ms, 600ms, 95ms, 99ms, 130ms, 5000ms, 60ms, 50ms, 400ms}) {
    learnt.observe(key, at);
    at += gap;
  }
  CHECK(learnt.pulse() == Steering::kPulse);
  for (int i = 0; i < 20; ++i) learnt.observe(Key{.character = i % 2 == 0 ? U'a' : U'd'}, at += 30ms);
  CHECK(learnt.pulse() == Steering::kPulse);
}

TEST_CASE("by the compass keys push that way in the picture, two together between them") {
  const core::Vec2 up{0.6, 0.8};
  const Handling handling{SteerBy::kCompass, up, 400ms, false};
  Steering steering(kTickHz);
  REQUIRE(drive(Action::kPushPulse, handling, steering, kStart));
  CHECK(std::abs(steering.heading().x - up.x) < 1e-12);
  drive(Action::kTurnRight, handling, steering, kStart + 100ms);
  const double half = std::sqrt(0.5);
  CHECK(steering.heading().x == Approx(half * (0.6 + 0.8)));
  CHECK(steering.heading().y == Approx(half * (0.8 - 0.6)));
  CHECK(steering.poll(kStart + 100ms));
  REQUIRE(steering.poll(kStart + 410ms));  // up has ended, right has not
  CHECK(steering.heading().x == Approx(0.8));
  CHECK(steering.pushing(kStart + 410ms));
  CHECK_FALSE(steering.pushing(kStart + 510ms));
  drive(Action::kStopPulse, handling, steering, kStart + 450ms);
  CHECK(steering.braking(kStart + 450ms));
}

TEST_CASE(
    "by the compass keys that are let go end their own push alone, and against each other push nowhere") {
  const Handling handling{SteerBy::kCompass, {0.0, 1.0}, 400ms, true};
  Steering steering(kTickHz);
  drive(Action::kPushHold, handling, steering, kStart);
  drive(Action::kTurnLeft, handling, steering, kStart);
  CHECK(steering.pushing(kStart + 5s));
  drive(Action::kPushRelease, handling, steering, kStart + 5s);
  REQUIRE(steering.poll(kStart + 5s));
  CHECK(steering.heading().x == Approx(-1.0));
  drive(Action::kTurnRight, handling, steering, kStart + 6s);
  CHECK_FALSE(steering.pushing(kStart + 6s));
  drive(Action::kTurnLeftRelease, handling, steering, kStart + 7s);
  CHECK(steering.pushing(kStart + 7s));
  drive(Action::kTurnRightRelease, handling, steering, kStart + 8s);
  CHECK_FALSE(steering.pushing(kStart + 8s));
}

TEST_CASE("a cruise goes where the compass was last told") {
  const Handling handling{SteerBy::kCompass, {0.0, 1.0}, 400ms, false};
  Steering steering(kTickHz);
  drive(Action::kCruise, handling, steering, kStart);
  drive(Action::kBrakePulse, handling, steering, kStart + 1s);  // down
  REQUIRE(steering.poll(kStart + 3s));
  CHECK(steering.cruising());
  CHECK(steering.heading().y == Approx(-1.0));
}

TEST_CASE("by the compass a press the other way ends the first at once") {
  const Handling handling{SteerBy::kCompass, {0.0, 1.0}, 400ms, false};
  Steering steering(kTickHz);
  drive(Action::kTurnRight, handling, steering, kStart);
  drive(Action::kTurnLeft, handling, steering, kStart + 50ms);
  CHECK(steering.heading().x == Approx(-1.0));
  CHECK(steering.pushing(kStart + 50ms));
}
