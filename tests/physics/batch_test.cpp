// The batched step against the scalar one: the same bits, whatever happens to a louse.
#include "shared/physics/batch.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/world.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using terrain::BicubicSpline;
using terrain::FunctionName;
using terrain::Terrain;

namespace {

std::vector<InstructionSet> batched_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (is_available(set)) sets.push_back(set);
  }
  return sets;
}

/// Walls, stops, brakes, pulses, rests and plain rolling, all in one world; the state after `ticks`.
std::vector<Louse> played(InstructionSet set, FunctionName name, const Parameters& parameters, double rate, int ticks) {
  World world(std::make_shared<const Terrain>(BicubicSpline(terrain::sample_function(name, 20.0, 10))), parameters, 1.0 / rate);
  world.use(set);
  core::Random random(17);
  const auto symmetric = [&] { return 2 * random.uniform() - 1; };
  constexpr LouseId kLice = 83;  // no multiple of any width
  for (LouseId id = 1; id <= kLice; ++id) {
    Louse louse;
    louse.id = id;
    louse.position = {20 * symmetric(), 20 * symmetric()};
    louse.velocity = {6 * symmetric(), 6 * symmetric()};
    world.insert(louse);
  }
  for (int tick = 0; tick < ticks; ++tick) {
    for (int i = 0; i < 4; ++i) {
      const auto id = static_cast<LouseId>(1 + random.next() % kLice);
      const auto pulse = static_cast<std::uint32_t>(1 + random.next() % 90);
      switch (random.next() % 4) {
        case 0: world.set_thrust(id, {ThrustKind::kMapVector, {0.7 * symmetric(), 0.7 * symmetric()}}, kHeld); break;
        case 1: world.set_thrust(id, {ThrustKind::kMapVector, {0.7 * symmetric(), 0.7 * symmetric()}}, pulse); break;
        case 2: world.set_thrust(id, {ThrustKind::kAlongHeading, {symmetric(), 0}}, pulse); break;
        default: world.set_thrust(id, {}, 0); break;
      }
    }
    world.step();
  }
  return {world.lice().begin(), world.lice().end()};
}

bool same_bits(const std::vector<Louse>& a, const std::vector<Louse>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Louse)) == 0;
}

}  // namespace

TEST_CASE("every instruction set gives the bits of the scalar step, over all forces, functions and rates") {
  for (const FunctionName name : terrain::kFunctionNames) {
    for (unsigned forces = 0; forces < 8; ++forces) {
      for (const double rate : {20.0, 60.0}) {
        const Parameters p{.gravity = 9.81,
                           .drag = forces & 4u ? 0.2 : 0.0,
                           .friction = forces & 2u ? 0.15 : 0.0,
                           .thrust_max = forces & 1u ? 4.0 : 0.0};
        const std::vector<Louse> scalar = played(InstructionSet::kScalar, name, p, rate, 200);
        for (const InstructionSet set : batched_sets()) {
          INFO(to_text(set) << ", " << terrain::to_text(name) << ", forces " << forces << ", " << rate << " Hz");
          REQUIRE(same_bits(played(set, name, p, rate, 200), scalar));
        }
      }
    }
  }
}

TEST_CASE("the scalar step is always available and the best set is an available one") {
  CHECK(is_available(InstructionSet::kScalar));
  CHECK(is_available(best_instruction_set()));
  CHECK(find_batch_step(InstructionSet::kScalar, true, true, true).width == 0);
}
