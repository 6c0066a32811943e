// Thrust on arrival: rounded to 1/128, clamped, the clamping told.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>

#include "shared/protocol/codec.h"

using namespace woodlouse;
using namespace woodlouse::protocol;

namespace {

Input thrust(const std::string& text) {
  const auto decoded = decode_client(R"({"type":"input","seq":1,"thrust":)" + text + "}");
  INFO(text);
  REQUIRE(decoded);
  return std::get<Input>(*decoded);
}

Input pair(double x, double y) {
  Input input;
  input.thrust = {state::ThrustKind::kMapVector, {x, y}};
  const auto decoded = decode_client(encode(ClientMessage(input)));
  REQUIRE(decoded);
  return std::get<Input>(*decoded);
}

bool is_multiple(double value) { return value * 128.0 == std::nearbyint(value * 128.0); }

}  // namespace

TEST_CASE("a number is rounded to the nearest 1/128") {
  CHECK(thrust("0.5").thrust.value == core::Vec2{0.5, 0.0});
  CHECK(thrust("0.3").thrust.value.x == 38.0 / 128.0);
  CHECK(thrust("-0.3").thrust.value.x == -38.0 / 128.0);
  CHECK(thrust("0.003").thrust.value.x == 0.0);
  CHECK(thrust("0.3").thrust.kind == state::ThrustKind::kAlongHeading);
  CHECK_FALSE(thrust("0.3").clamped);
}

TEST_CASE("a number out of range is clamped, and that is told") {
  for (const auto& [text, value] :
       {std::pair{"1.5", 1.0}, {"-2", -1.0}, {"1e308", 1.0}, {"-1e308", -1.0}, {"99", 1.0}}) {
    CHECK(thrust(text).thrust.value.x == value);
    CHECK(thrust(text).clamped);
  }
  CHECK_FALSE(thrust("1").clamped);
  CHECK_FALSE(thrust("-1").clamped);
  CHECK_FALSE(thrust("1.003").clamped);  // rounds to 1
}

TEST_CASE("a pair is rounded, and its length never passes 1") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> angle(-3.2, 3.2);
  std::uniform_real_distribution<double> exponent(-3.0, 3.0);
  for (int round = 0; round < 10000; ++round) {
    const double a = angle(random);
    const double length = round % 3 == 0 ? 1.0 : std::pow(10.0, exponent(random));
    const double x = length * std::cos(a);
    const double y = length * std::sin(a);
    const Input input = pair(x, y);
    REQUIRE(input.thrust.kind == state::ThrustKind::kMapVector);
    REQUIRE(is_multiple(input.thrust.value.x));
    REQUIRE(is_multiple(input.thrust.value.y));
    REQUIRE(core::dot(input.thrust.value, input.thrust.value) <= 1.0);
    const double kept = std::min(1.0, length);
    REQUIRE(std::abs(input.thrust.value.x - kept * std::cos(a)) <= 1.0 / 128.0);
    REQUIRE(std::abs(input.thrust.value.y - kept * std::sin(a)) <= 1.0 / 128.0);
    if (length <= 1.0) REQUIRE_FALSE(input.clamped);
    if (length > 1.01) REQUIRE(input.clamped);
  }
}

TEST_CASE("a unit vector is never called out of range") {
  for (int degree = 0; degree < 360; ++degree) {
    const double a = degree * 3.14159265358979323846 / 180.0;
    CHECK_FALSE(pair(std::cos(a), std::sin(a)).clamped);
  }
}

TEST_CASE("pairs beyond any range are scaled, not lost") {
  const Input input = thrust("[1e308,-1e308]");
  CHECK(input.clamped);
  CHECK(input.thrust.value.x == -input.thrust.value.y);
  CHECK(input.thrust.value.x == 90.0 / 128.0);
  CHECK(thrust("[0,1e308]").thrust.value == core::Vec2{0.0, 1.0});
}

TEST_CASE("what has been rounded stays as it is when it is sent again") {
  std::mt19937_64 random(5);
  for (int round = 0; round < 5000; ++round) {
    const Input once = pair(static_cast<double>(random() % 400) / 150.0 - 1.3,
                            static_cast<double>(random() % 400) / 150.0 - 1.3);
    const Input twice = pair(once.thrust.value.x, once.thrust.value.y);
    REQUIRE(twice.thrust == once.thrust);
    REQUIRE_FALSE(twice.clamped);
  }
}
