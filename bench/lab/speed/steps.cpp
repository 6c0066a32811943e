#include "bench/lab/speed/steps.h"

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/report/race.h"
#include "shared/core/random.h"
#include "shared/physics/world.h"

namespace woodlouse::lab {
namespace {

constexpr double kScale = 20.0;  // as the shipped maps
constexpr double kTick = 1.0 / 60.0;
constexpr double kNotRun = std::numeric_limits<double>::quiet_NaN();

state::Louse random_louse(core::Random& random, std::uint32_t id) {
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  state::Louse louse = louse_at({symmetric(15), symmetric(15)}, {symmetric(2), symmetric(2)});
  louse.id = id;
  const double angle = symmetric(std::numbers::pi);
  push(louse, {std::cos(angle), std::sin(angle)});
  return louse;
}

/// A room of lice that keep moving: each gets a new direction every two seconds.
class Room {
 public:
  static constexpr int kTicks = 10;

  Room(const terrain::BicubicSpline& spline, std::uint32_t lice, physics::InstructionSet set)
      : world_(std::make_shared<const terrain::Terrain>(spline), {}, kTick), lice_(lice) {
    world_.use(set);
    for (std::uint32_t id = 1; id <= lice; ++id) world_.insert(random_louse(random_, id));
  }
  void run() {
    for (std::uint32_t i = 0; i < lice_ / 12; ++i) {
      next_ = next_ % lice_ + 1;
      const double angle = 2.0 * std::numbers::pi * random_.uniform();
      world_.set_thrust(next_, {state::ThrustKind::kMapVector, {std::cos(angle), std::sin(angle)}},
                        state::kHeld);
    }
    for (int i = 0; i < kTicks; ++i) world_.step();
  }
  [[nodiscard]] double louse_steps() const { return static_cast<double>(lice_) * kTicks; }
  [[nodiscard]] double sub_steps() const {
    return static_cast<double>(world_.counters().sub_steps) /
           static_cast<double>(world_.counters().louse_steps);
  }
  [[nodiscard]] double awake() const {
    double awake = 0.0;
    for (const state::Louse& louse : world_.lice())
      awake += louse.phase != state::Phase::kResting ? 1.0 : 0.0;
    return awake / static_cast<double>(lice_);
  }

 private:
  physics::World world_;
  core::Random random_{2};
  std::uint32_t lice_;
  std::uint32_t next_ = 0;
};

/// Lice that run the same second again and again, by a stepper of the laboratory.
class Runners {
 public:
  static constexpr int kTicks = 20;

  Runners(std::unique_ptr<LaboratoryStepper> stepper, std::size_t lice) : stepper_(std::move(stepper)) {
    core::Random random(2);
    for (std::uint32_t id = 1; id <= lice; ++id) start_.push_back(random_louse(random, id));
  }
  void run() {
    std::vector<state::Louse> lice = start_;
    physics::StepCounters counters;
    for (int i = 0; i < kTicks; ++i) stepper_->advance(lice, counters);
    keep(lice.front());
  }
  [[nodiscard]] double louse_steps() const { return static_cast<double>(start_.size()) * kTicks; }

 private:
  std::unique_ptr<LaboratoryStepper> stepper_;
  std::vector<state::Louse> start_;
};

struct Entry {
  std::string name;
  double lice = 0.0;
  std::shared_ptr<Room> room;
  std::shared_ptr<Runners> runners;
};

core::Expected<Entry> runners(const document::AnySurface& surface, std::string name, Equations equations,
                              Integrator integrator, std::size_t lice) {
  auto stepper = make_stepper(surface, equations, integrator, state::Parameters{}, kNowhere, kTick);
  if (!stepper) return tl::unexpected(stepper.error());
  return Entry{std::move(name), static_cast<double>(lice), nullptr,
               std::make_shared<Runners>(std::move(*stepper), lice)};
}

core::Expected<void> measure_on(std::size_t knots, const Output& output, Table& table, Table& ratios) {
  using physics::InstructionSet;
  const terrain::HeightGrid grid =
      terrain::sample_function(terrain::FunctionName::kVolcano, kScale, (knots - 1) / 2);
  const terrain::BicubicSpline spline(grid);
  const document::AnySurface any(spline);
  const document::AnySurface papers{document::Spline(grid)};

  std::vector<Entry> entries;
  for (const std::uint32_t lice : {200u, 10000u}) {
    for (const auto set : {InstructionSet::kScalar, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      Entry entry{std::string("room, ") + physics::to_text(set), static_cast<double>(lice), nullptr, nullptr};
      if (physics::is_available(set)) entry.room = std::make_shared<Room>(spline, lice, set);
      entries.push_back(std::move(entry));
    }
  }
  for (const Integrator integrator :
       {Integrator::kFalseEuler, Integrator::kVerletQ, Integrator::kNystrom4, Integrator::kRungeKutta4,
        Integrator::kDormandPrince5, Integrator::kPrecise}) {
    auto entry =
        runners(any, std::string(to_text(integrator)) + ", scalar", Equations::kSurface, integrator, 200);
    if (!entry) return tl::unexpected(entry.error());
    entries.push_back(std::move(*entry));
  }
  auto documents = runners(papers, "the document's step", Equations::kAsPrinted, Integrator::kFalseEuler, 20);
  if (!documents) return tl::unexpected(documents.error());
  entries.push_back(std::move(*documents));

  std::vector<Contestant> contestants;
  for (const Entry& entry : entries) {
    if (entry.room)
      contestants.push_back({entry.name, [&entry] { entry.room->run(); }, entry.room->louse_steps()});
    if (entry.runners)
      contestants.push_back({entry.name, [&entry] { entry.runners->run(); }, entry.runners->louse_steps()});
  }
  const std::vector<Timing> times =
      race(contestants, output.effort(), "steps, " + std::to_string(knots) + " knots");
  const double documents_ns = times.back().median_ns;
  std::size_t next = 0;
  for (const Entry& entry : entries) {
    const bool runs = entry.room || entry.runners;
    const Timing time = runs ? times[next++] : Timing{kNotRun, kNotRun};
    table.add({entry.name, static_cast<double>(knots), entry.lice, time.median_ns, time.best_ns,
               entry.room ? entry.room->sub_steps() : kNotRun, entry.room ? entry.room->awake() : kNotRun,
               std::string(runs ? "" : "not run")});
    ratios.add({"the document's / " + entry.name, static_cast<double>(knots), entry.lice,
                runs ? Table::Cell(documents_ns / time.median_ns) : Table::Cell(std::string("not run"))});
  }
  return {};
}

}  // namespace

core::Expected<void> measure_steps(const Output& output) {
  Table table({"step", "knots", "lice", "ns", "ns_best", "sub_steps", "awake", "note"});
  Table ratios({"ratio", "knots", "lice", "times"});
  for (const std::size_t knots :
       output.quick ? std::vector<std::size_t>{201} : std::vector<std::size_t>{21, 201}) {
    if (auto done = measure_on(knots, output, table, ratios); !done) return done;
  }
  std::cout << "\nLouse-steps on volcano, scale " << kScale << " m, 60 Hz, drag, friction and thrust\n";
  table.print(std::cout);
  std::cout << '\n';
  ratios.print(std::cout);
  return output.write(table, "lab-speed-steps");
}

}  // namespace woodlouse::lab
