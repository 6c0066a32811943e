#include "bench/lab/skip_steps.h"

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/race.h"
#include "server/frames/frame_encoder.h"
#include "shared/core/random.h"
#include "shared/physics/attitude.h"
#include "shared/physics/world.h"
#include "shared/protocol/codec.h"

namespace woodlouse::lab {
namespace {

constexpr double kScale = 20.0;

std::shared_ptr<const terrain::Terrain> volcano() {
  return std::make_shared<const terrain::Terrain>(
      terrain::BicubicSpline(terrain::sample_function(terrain::FunctionName::kVolcano, kScale, 100)));
}

terrain::HeightGrid flat_grid() {
  return {201, 201, -kScale, -kScale, 0.2, 0.2, std::vector<double>(201 * 201, 0.0)};
}

/// Flat ground as maps have it.
std::shared_ptr<const terrain::Terrain> flat() {
  return std::make_shared<const terrain::Terrain>(*terrain::plane_through(flat_grid()));
}

std::vector<state::Louse> lice_of(std::size_t count, double speed) {
  core::Random random(17);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  std::vector<state::Louse> lice;
  for (std::size_t i = 0; i < count; ++i) {
    lice.push_back(louse_at({symmetric(15), symmetric(15)}, {symmetric(speed), symmetric(speed)}));
    lice.back().id = static_cast<state::LouseId>(i + 1);
  }
  return lice;
}

std::shared_ptr<physics::World> world_of(std::shared_ptr<const terrain::Terrain> ground,
                                         const state::Parameters& parameters, physics::InstructionSet set,
                                         const std::vector<state::Louse>& lice) {
  auto world = std::make_shared<physics::World>(std::move(ground), parameters, 1.0 / 60.0);
  world->use(set);
  for (const state::Louse& louse : lice) world->insert(louse);
  return world;
}

/// Twenty ticks of fresh copies, so that all of them move all the time; copying is a thousandth of it.
Contestant fresh_ticks(const std::shared_ptr<physics::World>& start) {
  constexpr int kTicks = 20;
  const auto run = [start] {
    physics::World world = *start;
    for (int i = 0; i < kTicks; ++i) world.step();
    keep(world.lice().front());
  };
  return {"", run, static_cast<double>(start->lice().size()) * kTicks};
}

Contestant ticks(const std::shared_ptr<physics::World>& world) {
  return {"", [world] { world->step(); }, static_cast<double>(world->lice().size())};
}

/// A pair of contestants and what their row says.
struct Duel {
  std::string what;
  std::string unit;
  Contestant computed;
  Contestant skipped;
};

/// One louse at a time, and as many as this machine can.
std::vector<physics::InstructionSet> slowest_and_best() {
  const auto best = physics::best_instruction_set();
  if (best == physics::InstructionSet::kScalar) return {best};
  return {physics::InstructionSet::kScalar, best};
}

void add_forces(std::vector<Duel>& duels) {
  const auto ground = volcano();
  const std::vector<state::Louse> lice = lice_of(200, 2.0);
  std::vector<state::Louse> pushed = lice;
  for (state::Louse& louse : pushed) push(louse, {0.6, 0.8});
  for (const auto set : slowest_and_best()) {
    duels.push_back({std::string("drag, friction, thrust compiled out, ") + physics::to_text(set),
                     "ns a louse-step", fresh_ticks(world_of(ground, {}, set, pushed)),
                     fresh_ticks(world_of(ground, {9.81, 0.0, 0.0, 0.0, 0.5}, set, lice))});
  }
}

/// Each force alone: the same motion with it compiled in, too weak to change a bit that shows, and compiled
/// out; the other two act. For the thrust's own pair nobody is pushed, as whoever is takes fewer sub-steps
/// under friction (halt.h), be it ever so weakly.
void add_each_force(std::vector<Duel>& duels) {
  constexpr double kFeeble = 1e-30;
  struct Force {
    const char* name;
    double state::Parameters::*strength;
  };
  const auto ground = volcano();
  const std::vector<state::Louse> free = lice_of(200, 2.0);
  std::vector<state::Louse> pushed = free;
  for (state::Louse& louse : pushed) push(louse, {0.6, 0.8});
  for (const auto set : slowest_and_best()) {
    for (const Force& force :
         {Force{"drag", &state::Parameters::drag}, Force{"friction", &state::Parameters::friction},
          Force{"thrust", &state::Parameters::thrust_max}}) {
      state::Parameters with, without;
      with.*force.strength = kFeeble;
      without.*force.strength = 0.0;
      const auto& lice = force.strength == &state::Parameters::thrust_max ? free : pushed;
      duels.push_back({std::string(force.name) + " alone left out, " + physics::to_text(set),
                       "ns a louse-step", fresh_ticks(world_of(ground, with, set, lice)),
                       fresh_ticks(world_of(ground, without, set, lice))});
    }
  }
}

void add_flat(std::vector<Duel>& duels) {
  std::vector<state::Louse> lice = lice_of(200, 2.0);
  for (state::Louse& louse : lice) push(louse, {0.6, 0.8});
  const auto curved = std::make_shared<const terrain::Terrain>(terrain::BicubicSpline(flat_grid()));
  for (const auto set : slowest_and_best()) {
    duels.push_back({std::string("curvature of flat ground, ") + physics::to_text(set), "ns a louse-step",
                     fresh_ticks(world_of(curved, {}, set, lice)),
                     fresh_ticks(world_of(flat(), {}, set, lice))});
  }
}

void add_resting(std::vector<Duel>& duels) {
  const auto set = physics::best_instruction_set();
  duels.push_back({"resting lice in no list, 10000", "ns a louse and tick",
                   fresh_ticks(world_of(flat(), {9.81, 0.2, 0.05, 4.0, 0.5}, set, lice_of(10000, 2.0))),
                   ticks(world_of(flat(), {9.81, 0.2, 0.05, 4.0, 0.5}, set, lice_of(10000, 0.0)))});
}

template <typename Sum>
Contestant sampler(const std::shared_ptr<const terrain::Terrain>& ground, const Sum& sum) {
  const auto points = std::make_shared<const std::vector<state::Louse>>(lice_of(4096, 1.0));
  const auto run = [ground, points, sum] {
    const auto& spline = std::get<terrain::BicubicSpline>(ground->surface());
    double total = 0.0;
    for (const state::Louse& louse : *points) total += sum(spline.sample(louse.position.x, louse.position.y));
    keep(total);
  };
  return {"", run, static_cast<double>(points->size())};
}

void add_hessians(std::vector<Duel>& duels) {
  const auto all = [](const terrain::SurfaceSample& s) { return s.z + s.zx + s.zy + s.zxx + s.zxy + s.zyy; };
  const auto gradient = [](const terrain::SurfaceSample& s) { return s.z + s.zx + s.zy; };
  const auto value = [](const terrain::SurfaceSample& s) { return s.z; };
  duels.push_back({"Hessian that no integrator asks for", "ns an evaluation", sampler(volcano(), all),
                   sampler(volcano(), gradient)});
  duels.push_back({"gradient and Hessian, only z asked for", "ns an evaluation", sampler(volcano(), all),
                   sampler(volcano(), value)});
}

Contestant key_frames(const std::shared_ptr<const terrain::Terrain>& ground,
                      std::vector<protocol::Column> columns) {
  const auto lice = std::make_shared<const std::vector<state::Louse>>(lice_of(200, 2.0));
  const auto encoder = std::make_shared<server::FrameEncoder>(
      server::RowLayout{std::move(columns), protocol::Format::kQuantized});
  const auto run = [ground, lice, encoder] { keep(encoder->key({0, 0, *lice, *ground, 0, {}})); };
  return {"", run, static_cast<double>(lice->size())};
}

void add_columns(std::vector<Duel>& duels) {
  using protocol::Column;
  const std::vector<Column> plain = protocol::default_columns();
  std::vector<Column> attitude = plain;
  for (const Column column : {Column::kYaw, Column::kPitch, Column::kRoll}) attitude.push_back(column);
  std::vector<Column> everything;
  for (std::size_t i = 0; i < protocol::kColumnCount; ++i) everything.push_back(static_cast<Column>(i));
  const auto ground = volcano();
  duels.push_back({"attitude (yaw pitch roll) nobody asked for", "ns a row", key_frames(ground, attitude),
                   key_frames(ground, plain)});
  duels.push_back({"columns nobody asked for: 18, default 5", "ns a row", key_frames(ground, everything),
                   key_frames(ground, plain)});
}

}  // namespace

core::Expected<void> measure_skipped_steps(Table& table, Effort effort) {
  std::vector<Duel> duels;
  add_forces(duels);
  add_each_force(duels);
  add_flat(duels);
  add_resting(duels);
  add_hessians(duels);
  add_columns(duels);
  std::vector<Contestant> contestants;
  for (const Duel& duel : duels) {
    contestants.push_back(duel.computed);
    contestants.push_back(duel.skipped);
  }
  const std::vector<Timing> times = race(contestants, effort, "what is skipped");
  for (std::size_t i = 0; i < duels.size(); ++i) {
    table.add({duels[i].what, duels[i].unit, times[2 * i].median_ns, times[2 * i + 1].median_ns});
  }
  return {};
}

}  // namespace woodlouse::lab
