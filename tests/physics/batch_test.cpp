// The batched step against the scalar one: the same bits, whatever happens to a louse.
#include "shared/physics/batch.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/ground_steps.h"
#include "shared/physics/world.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::BicubicSpline;
using terrain::FunctionName;
using terrain::Terrain;

namespace {

std::vector<InstructionSet> available_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::kScalar, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (is_available(set)) sets.push_back(set);
  }
  return sets;
}

/// The lice's motion, without the thrusts, which the world counts down after it.
std::vector<state::Louse> without_thrusts(std::span<const state::Louse> lice) {
  std::vector<state::Louse> bare(lice.begin(), lice.end());
  for (state::Louse& louse : bare) {
    louse.thrust = {};
    louse.thrust_kind = state::ThrustKind::kNone;
    louse.thrust_ticks = 0;
  }
  return bare;
}

bool same_bits(const std::vector<state::Louse>& a, const std::vector<state::Louse>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(state::Louse)) == 0;
}

/// Walls, stops, brakes, pulses, rests, sub-steps, caps and plain rolling, all in one world, and some who are
/// pressed against a wall; each tick of it against the same tick made louse by louse. The share of the lice
/// that the lanes left to that. No multiple of any width are they, or so few that narrower lanes take them.
template <typename Ground>
double check_every_tick(InstructionSet set, const Ground& ground, const state::Parameters& parameters,
                        double rate, double fastest, int ticks, state::LouseId lice = 83) {
  const auto terrain = std::make_shared<const Terrain>(ground);
  World world(terrain, parameters, 1.0 / rate);
  world.use(set);
  const auto louse_by_louse = make_ground_steps(ground, {parameters, terrain->domain(), 1.0 / rate});
  core::Random random(17);
  const auto symmetric = [&] { return 2 * random.uniform() - 1; };
  for (state::LouseId id = 1; id <= lice; ++id) {
    state::Louse louse;
    louse.id = id;
    louse.position = {20 * symmetric(), 20 * symmetric()};
    louse.velocity = {fastest * symmetric(), fastest * symmetric()};
    if (id % 4 == 0) {
      louse.position = id % 8 == 0 ? core::Vec2{20, louse.position.y} : core::Vec2{louse.position.x, -20};
      louse.velocity = id % 8 == 0 ? core::Vec2{0, louse.velocity.y} : core::Vec2{louse.velocity.x, 0};
    }
    world.insert(louse);
    if (id % 4 == 0)
      world.set_thrust(
          id, {state::ThrustKind::kMapVector, id % 8 == 0 ? core::Vec2{0.9, 0.2} : core::Vec2{-0.2, -0.9}},
          state::kHeld);
  }
  StepCounters counters;
  BatchLists lists;
  for (int tick = 0; tick < ticks; ++tick) {
    for (int i = 0; i < 4; ++i) {
      const auto id = static_cast<state::LouseId>(1 + random.next() % lice);
      const auto pulse = static_cast<std::uint32_t>(1 + random.next() % 90);
      switch (random.next() % 4) {
        case 0:
          world.set_thrust(id, {state::ThrustKind::kMapVector, {0.7 * symmetric(), 0.7 * symmetric()}},
                           state::kHeld);
          break;
        case 1:
          world.set_thrust(id, {state::ThrustKind::kMapVector, {0.7 * symmetric(), 0.7 * symmetric()}},
                           pulse);
          break;
        case 2:
          world.set_thrust(id, {state::ThrustKind::kAlongHeading, {symmetric(), 0}}, pulse);
          break;
        default:
          world.set_thrust(id, {}, 0);
          break;
      }
    }
    std::vector<state::Louse> expected(world.lice().begin(), world.lice().end());
    std::vector<std::uint32_t> moving;
    for (std::uint32_t i = 0; i < lice; ++i) {
      if (expected[i].phase != state::Phase::kResting) moving.push_back(i);
    }
    std::vector<StepEvents> events(expected.size());
    louse_by_louse->advance(expected, moving, {}, lists, counters, events);
    world.step();
    REQUIRE(std::equal(events.begin(), events.end(), world.events().begin(), world.events().end()));
    // A pulse that ends may wake a louse after its step.
    std::vector<state::Louse> stepped = without_thrusts(world.lice());
    std::vector<state::Louse> wanted = without_thrusts(expected);
    for (std::size_t i = 0; i < lice; ++i) {
      if (expected[i].thrust_ticks == 1) stepped[i].phase = wanted[i].phase;
    }
    REQUIRE(same_bits(stepped, wanted));
  }
  CHECK(world.counters().louse_steps == counters.louse_steps);
  CHECK(world.counters().sub_steps == counters.sub_steps);
  CHECK(world.counters().capped == counters.capped);
  CHECK(world.counters().bounces == counters.bounces);
  CHECK(world.counters().stops == counters.stops);
  CHECK(world.counters().flights == counters.flights);
  CHECK(world.counters().samples == counters.samples);
  return static_cast<double>(world.counters().left) / static_cast<double>(world.counters().louse_steps);
}

/// The same with every instruction set, over forces, rates and speeds. The lanes are to do nearly all of it.
template <typename Ground>
void check_on(const Ground& ground, const state::Parameters& physics, double most_left = 0.15) {
  for (unsigned forces = 0; forces < 8; ++forces) {
    for (const double rate : {20.0, 60.0}) {
      state::Parameters p = physics;
      p.drag = forces & 4u ? 0.2 : 0.0;
      p.friction = forces & 2u ? 0.15 : 0.0;
      p.thrust_max = forces & 1u ? 4.0 : 0.0;
      for (const InstructionSet set : available_sets()) {
        for (const double fastest : {6.0, 3000.0}) {
          INFO(to_text(set) << ", forces " << forces << ", " << rate << " Hz, " << fastest << " m/s");
          const double left = check_every_tick(set, ground, p, rate, fastest, fastest > 100 ? 5 : 100);
          if (fastest < 100) CHECK(left < most_left);
        }
      }
    }
  }
}

BicubicSpline spline_of(FunctionName name) { return BicubicSpline(terrain::sample_function(name, 20.0, 10)); }

}  // namespace

TEST_CASE("every instruction set gives the bits of the scalar step on the splines of all functions") {
  for (const FunctionName name : terrain::kFunctionNames) {
    INFO(terrain::to_text(name));
    check_on(spline_of(name), {});
  }
}

TEST_CASE("every instruction set gives the bits of the scalar step on planes, level and inclined") {
  for (const core::Vec2 slope : {core::Vec2{}, core::Vec2{0.12, -0.3}}) {
    check_on(terrain::PlaneSurface({-20, -20, 20, 20}, 1.0, slope), {});
  }
}

TEST_CASE("every instruction set gives the bits of the scalar step where lice take off, fly and land") {
  for (const double gravity : {2.0, 9.81}) {
    state::Parameters p;
    p.gravity = gravity;
    p.contact = SurfaceContact::kUnilateral;
    check_on(spline_of(FunctionName::kHills), p);
    p.edges = Edges::kWrap;
    check_on(spline_of(FunctionName::kWaves), p);
  }
}

TEST_CASE("every instruction set gives the bits of the scalar step over seams") {
  state::Parameters p;
  p.edges = Edges::kWrap;
  check_on(spline_of(FunctionName::kWaves), p);
}

TEST_CASE("every instruction set gives the bits of the scalar step where the edges are open") {
  constexpr double kMostLeft = 0.6;  // who stands at one and is drawn outwards stays there
  state::Parameters p;
  p.edges = Edges::kOpen;
  check_on(spline_of(FunctionName::kVolcano), p, kMostLeft);
  check_on(terrain::PlaneSurface({-20, -20, 20, 20}, 1.0, {0.12, -0.3}), p, kMostLeft);
  p.contact = SurfaceContact::kUnilateral;
  p.gravity = 2.0;
  check_on(spline_of(FunctionName::kHills), p, kMostLeft);
  p.contact = SurfaceContact::kBilateral;
  p.gravity = 0.0;
  p.central_gravity = 100.0;
  p.core_radius = 9.0;
  check_on(spline_of(FunctionName::kVolcano), p, kMostLeft);
}

TEST_CASE(
    "every instruction set gives the bits of the scalar step under central gravity, its core included") {
  for (const double core_radius : {0.25, 9.0}) {
    for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
      state::Parameters p;
      p.gravity = contact == SurfaceContact::kBilateral ? 0.0 : 3.0;
      p.contact = contact;
      p.central_gravity = 100.0;
      p.core_radius = core_radius;
      check_on(terrain::PlaneSurface({-20, -20, 20, 20}, 1.0, {0.1, -0.05}), p);
      check_on(spline_of(FunctionName::kVolcano), p);
    }
  }
}

TEST_CASE("every instruction set gives the bits of the scalar step where a map bears only so much of error") {
  constexpr double kMostLeft = 1.0;  // who errs more is left, and so is who turns along
  for (const double tolerance : {1e-2, 1e-5}) {
    state::Parameters p;
    p.tolerance = tolerance;
    check_on(spline_of(FunctionName::kHills), p, kMostLeft);
    check_on(terrain::PlaneSurface({-20, -20, 20, 20}, 1.0, {0.12, -0.3}), p, kMostLeft);
    p.edges = Edges::kWrap;
    p.contact = SurfaceContact::kUnilateral;
    check_on(spline_of(FunctionName::kWaves), p, kMostLeft);
  }
  state::Parameters p;
  p.tolerance = 1e-4;
  p.gravity = 0.0;
  p.central_gravity = 100.0;
  p.core_radius = 0.25;
  check_on(spline_of(FunctionName::kVolcano), p, kMostLeft);
}

TEST_CASE("the lanes do most of the steps of a map whose tolerance they meet") {
  state::Parameters p;
  p.tolerance = 1e-2;
  for (const InstructionSet set : available_sets()) {
    INFO(to_text(set));
    CHECK(check_every_tick(set, spline_of(FunctionName::kHills), p, 240.0, 6.0, 100) < 0.5);
  }
}

TEST_CASE("every instruction set gives the bits of the scalar step to few lice, too") {
  for (state::LouseId lice = 1; lice <= kFewLice + 1; ++lice) {
    for (const InstructionSet set : available_sets()) {
      for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
        INFO(lice << " lice, " << to_text(set) << ", " << state::to_text(contact));
        state::Parameters p;
        p.drag = 0.2;
        p.friction = 0.15;
        p.thrust_max = 4.0;
        p.contact = contact;
        check_every_tick(set, spline_of(FunctionName::kHills), p, 20.0, 6.0, 400, lice);
      }
    }
  }
}

TEST_CASE("the scalar step is always available and the best set is an available one") {
  CHECK(is_available(InstructionSet::kScalar));
  CHECK(is_available(best_instruction_set()));
  CHECK(find_batch_step(InstructionSet::kScalar, BatchGround::kBicubicSpline, {true, true, true}).width == 1);
}
