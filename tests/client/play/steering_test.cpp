#include "client/play/steering.h"

#include <catch2/catch.hpp>
#include <cmath>

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

TEST_CASE("a turn while pushing is sent at once, for the rest of the pulse") {
  Steering steering(kTickHz);
  steering.point({1.0, 0.0});
  steering.push(kStart);
  steering.poll(kStart);
  steering.turn(Turn::kLeft);
  const auto order = steering.poll(kStart + 100ms);
  REQUIRE(order);
  REQUIRE(order->ticks == 18);
  REQUIRE(std::atan2(order->thrust.value.y, order->thrust.value.x) == Approx(0.3927).margin(0.01));
}

TEST_CASE("sixteen turns come back to the first heading, and left undoes right") {
  Steering steering(kTickHz);
  steering.point({0.6, 0.8});
  for (int i = 0; i < 16; ++i) steering.turn(Turn::kRight);
  REQUIRE(steering.heading().x == Approx(0.6));
  steering.turn(Turn::kLeft);
  steering.turn(Turn::kRight);
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
