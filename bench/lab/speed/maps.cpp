#include "bench/lab/speed/maps.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/race.h"
#include "shared/core/random.h"
#include "shared/core/thread_team.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/map/map_world.h"
#include "shared/state/state_hash.h"

namespace woodlouse::lab {
namespace {

constexpr double kTick = 1.0 / 60.0;
constexpr std::uint32_t kChangeTicks = 120;  // a held thrust points elsewhere after that many ticks

using MapPointer = std::shared_ptr<const map::Map>;

/// How often the lice of a crowd are pushed elsewhere.
enum class Steering { kHeld, kEachTick };

struct Scene {
  MapPointer map;
  std::uint32_t lice = 0;
  physics::InstructionSet set{};
  Steering steering = Steering::kHeld;
  bool hashed = true;
  std::size_t threads = 1;
};

/// Lice all over a map that are pushed about.
class Crowd {
 public:
  /// settled: after so many ticks they are where pushes and walls bring them.
  Crowd(const Scene& scene, int settled)
      : scene_(scene), world_(map::make_world(*scene.map, kTick)), ticks_(scene.lice < 100000 ? 10 : 1) {
    world_.use(scene.set);
    if (scene.threads > 1) team_ = std::make_shared<core::ThreadTeam>(scene.threads);
    world_.use(team_);
    const terrain::Rectangle domain = scene.map->terrain->domain();
    const auto between = [&](double low, double high) {
      return 0.5 * (low + high) + 0.45 * (high - low) * symmetric();
    };
    std::vector<state::Louse> lice;
    for (std::uint32_t id = 1; id <= scene.lice; ++id) {
      lice.push_back(louse_at({between(domain.x_min, domain.x_max), between(domain.y_min, domain.y_max)},
                              {2.0 * symmetric(), 2.0 * symmetric()}));
      lice.back().id = id;
    }
    world_.restore(lice);
    for (std::uint32_t id = 1; id <= scene.lice; ++id) push_anywhere(id);
    for (int tick = 0; tick < settled; ++tick) step();
    begin_ = world_.counters();
  }

  void run() {
    for (int i = 0; i < ticks_; ++i) {
      step();
      if (scene_.hashed) hash();
    }
  }
  [[nodiscard]] double louse_ticks() const { return static_cast<double>(scene_.lice) * ticks_; }
  [[nodiscard]] double awake() const {
    const auto moves = [](const state::Louse& louse) { return louse.phase != state::Phase::kResting; };
    return static_cast<double>(std::count_if(world_.lice().begin(), world_.lice().end(), moves)) /
           static_cast<double>(scene_.lice);
  }
  /// Sub-steps, and of the lice those that took the scalar step.
  [[nodiscard]] std::pair<double, double> shares() const {
    const physics::StepCounters& c = world_.counters();
    const double steps = static_cast<double>(c.louse_steps - begin_.louse_steps);
    return {static_cast<double>(c.sub_steps - begin_.sub_steps) / steps,
            static_cast<double>(c.left - begin_.left) / steps};
  }

 private:
  double symmetric() { return 2.0 * random_.uniform() - 1.0; }

  void push_anywhere(std::uint32_t id) {
    const double angle = std::numbers::pi * symmetric();
    world_.set_thrust(id, {state::ThrustKind::kMapVector, {std::cos(angle), std::sin(angle)}}, state::kHeld);
  }
  void step() {
    const std::uint32_t count = scene_.steering == Steering::kEachTick
                                    ? scene_.lice
                                    : (scene_.lice + due_++ % kChangeTicks) / kChangeTicks;
    for (std::uint32_t i = 0; i < count; ++i) {
      next_ = next_ % scene_.lice + 1;
      push_anywhere(next_);
    }
    world_.step();
  }
  void hash() {
    blocks_.update(world_.lice(), world_.changed_blocks(), team_.get());
    world_.forget_changes();
    hash_ = state::state_hash(hasher_, {hash_, 0, 0, 0, ++hashes_, 0}, blocks_.values());
    keep(hash_);
  }

  Scene scene_;
  core::Random random_{2};
  std::shared_ptr<core::Team> team_;
  physics::World world_;
  int ticks_;
  std::uint32_t next_ = 0;
  std::uint32_t due_ = 0;
  physics::StepCounters begin_;
  core::StableHasher hasher_;
  state::BlockHashes blocks_;
  std::uint64_t hash_ = 0;
  std::uint64_t hashes_ = 0;
};

std::vector<physics::InstructionSet> available_sets() {
  using physics::InstructionSet;
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::kScalar, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (physics::is_available(set)) sets.push_back(set);
  }
  return sets;
}

using Crowds = std::vector<std::unique_ptr<Crowd>>;

Crowds crowds_of(const std::vector<Scene>& scenes, Effort effort) {
  Crowds crowds;
  for (const Scene& scene : scenes) {
    const int settled = effort == Effort::kQuick ? 120 : (scene.lice < 100000 ? 600 : 60);
    crowds.push_back(std::make_unique<Crowd>(scene, settled));
  }
  return crowds;
}

/// Of a louse and tick.
std::vector<Timing> times_of(const Crowds& crowds, const std::string& what, Effort effort,
                             Clock clock = Clock::kProcessor) {
  std::vector<Contestant> contestants;
  for (const auto& crowd : crowds)
    contestants.push_back({"", [&crowd = *crowd] { crowd.run(); }, crowd->louse_ticks()});
  return race(contestants, effort, what, clock);
}

/// The scenes of one map beside each other.
void measure_scenes(const std::vector<Scene>& scenes, const std::string& what, Effort effort, Table& table) {
  const Crowds crowds = crowds_of(scenes, effort);
  const std::vector<Timing> times = times_of(crowds, what, effort);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    const auto [sub_steps, left] = crowds[i]->shares();
    table.add({scene.map->definition.name, static_cast<double>(scene.lice),
               std::string(physics::to_text(scene.set)),
               std::string(scene.steering == Steering::kHeld ? "held" : "each tick"),
               std::string(scene.hashed ? "yes" : "no"), times[i].median_ns, times[i].best_ns, sub_steps,
               left, crowds[i]->awake()});
  }
}

/// The cost of a louse as they become many, a line a map, from rows of the table: gnuplot's script.
std::string growth_picture(const std::vector<std::vector<Table::Cell>>& rows) {
  std::map<std::string, std::map<double, double>> ns_by_lice;
  const std::string best = physics::to_text(physics::best_instruction_set());
  const auto text = [](const Table::Cell& cell) { return std::get<std::string>(cell); };
  for (const auto& row : rows) {
    if (text(row[2]) == best && text(row[3]) == "held" && text(row[4]) == "yes")
      ns_by_lice[text(row[0])][std::get<double>(row[1])] = std::get<double>(row[5]);
  }
  std::ostringstream script;
  script << "set logscale xy\nset grid\nset key outside right\nset xlabel 'lice'\n"
         << "set ylabel 'ns a louse and tick, " << best << ", with its hash'\nset yrange [20:2000]\n";
  std::ostringstream lines;
  int number = 0;
  for (const auto& [name, points] : ns_by_lice) {
    script << "$map" << ++number << " << end\n";
    for (const auto& [lice, ns] : points) script << lice << ' ' << ns << '\n';
    script << "end\n";
    lines << "$map" << number << " with linespoints title '" << name << "' noenhanced, ";
  }
  script << "plot " << lines.str() << "NaN notitle\n";
  return script.str();
}

}  // namespace

core::Expected<std::vector<std::shared_ptr<const map::Map>>> maps_of(std::filesystem::path folder) {
  if (folder.empty()) {
    const auto shipped = map::find_map("volcano");
    if (!shipped) return tl::unexpected(shipped.error());
    folder = shipped->parent_path();
  }
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (files.empty())
    return core::fail(folder.string(), "no map in this folder", "name the project's maps with --maps");
  std::sort(files.begin(), files.end());
  std::vector<MapPointer> maps;
  for (const auto& file : files) {
    auto map = map::load_map(file);
    if (!map) return tl::unexpected(map.error());
    maps.push_back(std::move(*map));
  }
  return maps;
}

core::Expected<void> measure_maps(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const physics::InstructionSet best = physics::best_instruction_set();
  const std::uint32_t many = output.quick ? 200 : 1000;
  Table table({"map", "lice", "set", "thrust", "hash", "ns", "ns_best", "sub_steps", "left", "awake"});
  for (const MapPointer& map : *maps) {
    const std::string& name = map->definition.name;
    std::vector<Scene> scenes;
    for (const auto set : available_sets()) scenes.push_back({map, many, set});
    scenes.push_back({map, many, best, Steering::kHeld, false});
    scenes.push_back({map, many, best, Steering::kEachTick});
    measure_scenes(scenes, "maps, " + name, output.effort(), table);
    if (output.quick) continue;
    scenes.clear();
    for (const std::uint32_t lice : {1u, 10u, 100u, 10000u, 100000u, 1000000u})
      scenes.push_back({map, lice, best});
    measure_scenes(scenes, "growth, " + name, output.effort(), table);
  }
  std::cout << "\nA louse and tick on the shipped maps, 60 Hz; left: taken by the scalar step\n";
  table.print(std::cout);
  if (auto done = output.write(table, "lab-speed-maps"); !done || output.quick) return done;
  return output.draw(growth_picture(table.rows()), "lab-speed-maps", 760, 420);
}

core::Expected<void> measure_threads(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const AnyCore any_core;
  const physics::InstructionSet best = physics::best_instruction_set();
  const std::vector<std::uint32_t> crowds_told =
      output.quick ? std::vector<std::uint32_t>{4000} : std::vector<std::uint32_t>{1000, 10000, 100000};
  Table table({"map", "lice", "ns_one", "ns_two", "times_as_fast"});
  for (const MapPointer& map : *maps) {
    for (const std::uint32_t lice : crowds_told) {
      const Crowds crowds =
          crowds_of({{map, lice, best}, {map, lice, best, Steering::kHeld, true, 2}}, output.effort());
      const std::string& name = map->definition.name;
      const auto times = times_of(crowds, "threads, " + name, output.effort(), Clock::kWall);
      table.add({name, static_cast<double>(lice), times[0].median_ns, times[1].median_ns,
                 times[0].median_ns / times[1].median_ns});
    }
  }
  std::cout << "\nA louse and tick by one thread and by two, its hash included: the time that passes\n";
  table.print(std::cout);
  return output.write(table, "lab-speed-threads");
}

}  // namespace woodlouse::lab
