// The one list of a louse's fields against the louse itself.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/state/louse_fields.h"

using namespace woodlouse;
using namespace woodlouse::state;

namespace {

double some_value(const LouseField& field, core::Random& random) {
  if (holds_integer(field)) return static_cast<double>(random.next() % (std::uint64_t{field.largest} + 1));
  return 200.0 * random.uniform() - 100.0;
}

}  // namespace

TEST_CASE("fields set by the list make the louse whose members are set by name") {
  Louse louse;
  louse.id = 7;
  louse.phase = Phase::kFlying;
  louse.position = {1.5, -2.5};
  louse.velocity = {3.5, -0.0};
  louse.heading = {0.6, -0.8};
  louse.thrust = {0.25, 0.5};
  louse.flight_z = 9.0;
  louse.flight_vz = -1.0;
  louse.distance = 1e6;
  louse.thrust_kind = ThrustKind::kMapVector;
  louse.thrust_ticks = kHeld;
  const std::vector<double> values = {7,    2,   1.5, -2.5, 3.5, -0.0, 0.6,         -0.8,
                                      0.25, 0.5, 9.0, -1.0, 1e6, 2,    4294967295.0};
  const Louse made = louse_of(values);
  CHECK(std::memcmp(&made, &louse, sizeof louse) == 0);
}

TEST_CASE("a louse of random fields gives the same fields back, bit for bit") {
  core::Random random(5);
  for (int round = 0; round < 1000; ++round) {
    std::vector<double> values;
    for (const LouseField& field : kLouseFields) values.push_back(some_value(field, random));
    const Louse louse = louse_of(values);
    for (std::size_t k = 0; k < kLouseFields.size(); ++k) {
      const double value = field_value(louse, kLouseFields[k]);
      REQUIRE(std::memcmp(&value, &values[k], sizeof value) == 0);
    }
  }
}

TEST_CASE("names are distinct and found, quanta are powers of two") {
  std::set<std::string_view> names;
  for (const LouseField& field : kLouseFields) {
    CHECK(names.insert(field.name).second);
    CHECK(find_field(field.name) == &field);
    int exponent = 0;
    CHECK(std::frexp(field.quantum, &exponent) == 0.5);
    CHECK((field.largest != 0) == holds_integer(field));
  }
  CHECK(find_field("yaw") == nullptr);
}
