// What the inner loops cost: spline evaluations, louse-steps, encoded rows. Google Benchmark; how to run it
// and what it printed where: bench/results/README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/frames/row_table.h"
#include "shared/core/random.h"
#include "shared/core/stable_hash.h"
#include "shared/core/thread_team.h"
#include "shared/physics/world.h"
#include "shared/protocol/codec.h"
#include "shared/state/state_hash.h"
#include "shared/terrain/terrain.h"

namespace {

using namespace woodlouse;
using terrain::BicubicSpline;
using terrain::FunctionName;

constexpr double kScale = 20.0;

BicubicSpline volcano(std::size_t knots) {
  return BicubicSpline(terrain::sample_function(FunctionName::kVolcano, kScale, (knots - 1) / 2));
}

/// Coherent points follow a slow walk from cell to neighbouring cell; random ones jump anywhere.
enum class Order { kRandom, kCoherent };

std::vector<core::Vec2> points(Order order) {
  core::Random random(1);
  std::vector<core::Vec2> result(4096);
  core::Vec2 p;
  for (core::Vec2& point : result) {
    const core::Vec2 u{2 * random.uniform() - 1, 2 * random.uniform() - 1};
    p = order == Order::kRandom ? (kScale * u) : core::Vec2{p.x + 0.01 * u.x, p.y + 0.01 * u.y};
    point = p;
  }
  return result;
}

void spline_evaluation(benchmark::State& state, Order order) {
  const BicubicSpline spline = volcano(static_cast<std::size_t>(state.range(0)));
  const auto at = points(order);
  std::size_t i = 0;
  for (auto _ : state) {
    const core::Vec2 p = at[i++ & 4095];
    terrain::SurfaceSample s = spline.sample(p.x, p.y);
    benchmark::DoNotOptimize(s);
  }
}

/// A world's hashes, made as a match makes them.
class HashChain {
 public:
  void add(physics::World& world, std::uint64_t tick, core::Team* team = nullptr) {
    blocks_.update(world.lice(), world.changed_blocks(), team);
    world.forget_changes();
    hash_ = state::state_hash(hasher_, {hash_, 0, 0, 0, tick, 0}, blocks_.values());
    benchmark::DoNotOptimize(hash_);
  }

 private:
  core::StableHasher hasher_;
  state::BlockHashes blocks_;
  std::uint64_t hash_ = 0;
};

/// Lice all moving under thrust on the volcano.
class DrivenLice {
 public:
  DrivenLice(std::uint32_t count, std::size_t knots)
      : count_(count), world_(std::make_shared<const terrain::Terrain>(volcano(knots)), {}, 1.0 / 60) {
    std::vector<state::Louse> lice(count);
    for (std::uint32_t id = 1; id <= count; ++id) {
      lice[id - 1].id = id;
      lice[id - 1].phase = state::Phase::kMoving;
      lice[id - 1].position = {15 * symmetric(), 15 * symmetric()};
      lice[id - 1].velocity = {2 * symmetric(), 2 * symmetric()};
    }
    world_.restore(lice);
    steer();
  }

  void use(const std::shared_ptr<core::Team>& team) {
    team_ = team;
    world_.use(team);
  }
  /// A new direction every two seconds.
  [[nodiscard]] bool is_to_steer() const { return tick_ % 120 == 119; }
  void steer() {
    for (std::uint32_t id = 1; id <= count_; ++id) {
      const double angle = 3.14159 * symmetric();
      world_.set_thrust(id, {state::ThrustKind::kMapVector, {std::cos(angle), std::sin(angle)}},
                        state::kHeld);
    }
  }
  /// One tick, its state hash included.
  void tick() {
    world_.step();
    hashes_.add(world_, ++tick_, team_.get());
  }
  [[nodiscard]] const physics::World& world() const { return world_; }

 private:
  double symmetric() { return 2 * random_.uniform() - 1; }

  std::uint32_t count_;
  core::Random random_{2};
  std::shared_ptr<core::Team> team_;
  physics::World world_;
  HashChain hashes_;
  std::uint64_t tick_ = 0;
};

void world_tick(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  DrivenLice lice(count, static_cast<std::size_t>(state.range(1)));
  std::uint64_t hashed = 0;
  for (auto _ : state) {
    if (lice.is_to_steer()) {  // not timed
      state.PauseTiming();
      lice.steer();
      state.ResumeTiming();
    }
    lice.tick();
    hashed += count;
  }
  const auto& c = lice.world().counters();
  state.counters["louse-step"] = benchmark::Counter(
      static_cast<double>(hashed), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["awake"] = static_cast<double>(c.louse_steps) / static_cast<double>(hashed);
  state.counters["sub-steps"] = static_cast<double>(c.sub_steps) / static_cast<double>(c.louse_steps);
}

/// The same game by one thread and by several, their ticks in turns: one iteration is a tick of each, the
/// time is that of several. With a pause before each tick, as in a room, the threads sleep when one is due.
void world_tick_threads(benchmark::State& state, core::Cut cut) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto threads = static_cast<std::size_t>(state.range(1));
  const std::chrono::milliseconds pause(state.range(2));
  DrivenLice alone(count, 21), together(count, 21);
  together.use(std::make_shared<core::ThreadTeam>(threads, cut));
  std::vector<double> alone_seconds, together_seconds;
  const auto timed_tick = [pause](DrivenLice& lice, std::vector<double>& seconds) {
    if (lice.is_to_steer()) lice.steer();
    if (pause.count() != 0) std::this_thread::sleep_for(pause);
    const auto begin = std::chrono::steady_clock::now();
    lice.tick();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  };
  bool is_together_first = false;
  for (auto _ : state) {
    if (is_together_first) timed_tick(together, together_seconds);
    timed_tick(alone, alone_seconds);
    if (!is_together_first) timed_tick(together, together_seconds);
    is_together_first = !is_together_first;
    state.SetIterationTime(together_seconds.back());
  }
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  state.counters["alone_us"] = 1e6 * median(alone_seconds);
  state.counters["together_us"] = 1e6 * median(together_seconds);
  state.counters["faster"] = median(alone_seconds) / median(together_seconds);
}

/// `count` lice at rest and one that drives: one iteration is one tick, its state hash included.
void resting_tick(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto flat =
      std::make_shared<const terrain::Terrain>(terrain::PlaneSurface({-20, -20, 20, 20}, 0, {}));
  constexpr double kFar = std::numeric_limits<double>::infinity();
  physics::World world(flat, {}, 1.0 / 60, {-kFar, -kFar, kFar, kFar});  // no wall to rest at
  for (std::uint32_t id = 1; id <= count + 1; ++id) {
    state::Louse louse;
    louse.id = id;
    world.insert(louse);
  }
  world.set_thrust(count + 1, {state::ThrustKind::kAlongHeading, {1.0, 0.0}}, state::kHeld);
  HashChain hashes;
  std::uint64_t tick = 0;
  for (auto _ : state) {
    world.step();
    hashes.add(world, ++tick);
  }
  state.counters["louse"] = benchmark::Counter(static_cast<double>(tick) * count,
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["awake"] = static_cast<double>(world.counters().louse_steps) / static_cast<double>(tick);
}

/// One row of those columns, as the server writes it.
void row_encoding(benchmark::State& state, const std::vector<protocol::Column>& columns,
                  protocol::Format format) {
  const server::RowTable writer({columns, format});
  const terrain::Terrain terrain{volcano(21)};
  core::Random random(3);
  const auto metres = [&] { return 40 * random.uniform() - 20; };
  std::vector<state::Louse> lice(1024);
  for (std::size_t i = 0; i < lice.size(); ++i) {
    lice[i].id = static_cast<std::uint32_t>(i + 1);
    lice[i].position = {metres(), metres()};
    lice[i].velocity = {metres(), metres()};
  }
  std::string text;
  std::size_t row = 0;
  for (auto _ : state) {
    if (row % lice.size() == 0) text.clear();
    writer.append(text, lice[row++ % lice.size()], {}, terrain);
    benchmark::DoNotOptimize(text.data());
  }
}

void input_line(benchmark::State& state, std::string_view thrust) {
  const std::string line =
      R"({"type":"input","seq":1234,"thrust":)" + std::string(thrust) + R"(,"ticks":12})";
  for (auto _ : state) {
    auto message = protocol::decode_client(line);
    benchmark::DoNotOptimize(message);
  }
}

/// With the exact state of a louse on its way.
void ack_line(benchmark::State& state) {
  protocol::Ack ack{1234, 56789, 8123, false, false, false, protocol::ExactState{56790, {}}};
  state::Louse& louse = ack.you->louse;
  louse.id = 17;
  louse.position = {1.2345678901234567, -9.876543210987654};
  louse.velocity = {0.1234567890123456, 3.3333333333333335};
  louse.heading = {0.6, -0.8};
  louse.thrust = {0.5, -0.25};
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.distance = 123.45678901234567;
  std::string text;
  for (auto _ : state) {
    text.clear();
    protocol::append(text, protocol::ServerMessage(ack));
    benchmark::DoNotOptimize(text.data());
  }
}

void state_hash(benchmark::State& state) {
  const std::vector<state::Louse> lice(static_cast<std::size_t>(state.range(0)));
  core::StableHasher hasher;
  std::uint64_t hash = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(hash = state::state_hash(hasher, {hash, 0, 0, 0, 0, 0}, lice));
}

}  // namespace

BENCHMARK_CAPTURE(spline_evaluation, random, Order::kRandom)->ArgName("knots")->Arg(21)->Arg(201)->Arg(1001);
BENCHMARK_CAPTURE(spline_evaluation, coherent, Order::kCoherent)
    ->ArgName("knots")
    ->Arg(21)
    ->Arg(201)
    ->Arg(1001);
BENCHMARK(world_tick)->ArgNames({"lice", "knots"})->ArgsProduct({{1, 1000, 10000}, {21, 201}});
BENCHMARK_CAPTURE(world_tick_threads, as_served, core::Cut::kWorthIt)
    ->ArgNames({"lice", "threads", "pause_ms"})
    ->ArgsProduct({{100, 300, 1000, 3000, 10000, 100000}, {1, 2}, {0, 4}})
    ->Iterations(300)
    ->UseManualTime();
BENCHMARK_CAPTURE(world_tick_threads, always, core::Cut::kFinest)
    ->ArgNames({"lice", "threads", "pause_ms"})
    ->ArgsProduct({{500, 1000, 1500, 2000, 2500, 3000, 4000, 6000}, {2}, {4}})
    ->Iterations(300)
    ->UseManualTime();
BENCHMARK(resting_tick)->ArgName("lice")->Arg(1000)->Arg(10000);
BENCHMARK_CAPTURE(row_encoding, quantized, protocol::default_columns(), protocol::Format::kQuantized);
BENCHMARK_CAPTURE(row_encoding, exact, protocol::default_columns(), protocol::Format::kExact);
BENCHMARK_CAPTURE(row_encoding, all_exact, protocol::all_columns(), protocol::Format::kExact);
BENCHMARK_CAPTURE(row_encoding, height_and_speed,
                  std::vector<protocol::Column>{protocol::Column::kId, protocol::Column::kX,
                                                protocol::Column::kY, protocol::Column::kZ,
                                                protocol::Column::kSpeed},
                  protocol::Format::kQuantized);
BENCHMARK_CAPTURE(input_line, pair, "[0.5,-0.25]");
BENCHMARK_CAPTURE(input_line, number, "-0.75");
BENCHMARK(ack_line);
BENCHMARK(state_hash)->ArgName("lice")->Arg(8)->Arg(200)->Arg(10000);

BENCHMARK_MAIN();
