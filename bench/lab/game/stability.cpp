#include "bench/lab/game/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bench/lab/game/energy.h"
#include "bench/lab/game/scene.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "bench/lab/speed/maps.h"

namespace woodlouse::lab {
namespace {

/// What acts beside gravity and the ground.
enum class Acts { kNothing, kResistance, kBrake, kVectors, kHeadings };
constexpr std::array kActs = {Acts::kNothing, Acts::kResistance, Acts::kBrake, Acts::kVectors,
                              Acts::kHeadings};
constexpr std::array<const char*, kActs.size()> kActNames = {"nothing", "drag, friction", "brake",
                                                             "vector each tick", "heading each tick"};
constexpr std::array kContacts = {state::SurfaceContact::kBilateral, state::SurfaceContact::kUnilateral};

struct Scene {
  const map::Map& map;
  Acts acts;
  state::SurfaceContact contact;
};

struct Found {
  double gained = 0.0, lost = 0.0, capped = 0.0, not_finite = 0.0, outside = 0.0;
  double at_rate = 0.0;  ///< where most was gained
};

/// The map's own physics, but for what does not act.
map::Map made_for(const Scene& scene) {
  map::Map map = scene.map;
  state::Parameters& p = map.definition.physics;
  p.contact = scene.contact;
  if (scene.acts == Acts::kNothing) {
    p.drag = p.friction = 0.0;
    p.edge_restitution = 1.0;
  }
  return map;
}

/// Null: the method is not for this map.
std::optional<Found> run(const Scene& scene, Integrator integrator, const std::vector<int>& rates,
                         double seconds, std::size_t lice) {
  const map::Map map = made_for(scene);
  Found found;
  for (const int rate : rates) {
    const auto world = world_of(map, integrator, rate);
    if (world == nullptr) return std::nullopt;
    world->restore(starting_lice(map, lice, 6));
    if (scene.acts == Acts::kBrake) {
      for (std::size_t i = 0; i < lice; ++i)
        world->set_thrust(world->lice()[i].id, {state::ThrustKind::kAlongHeading, {-0.25, 0.0}},
                          state::kHeld);
    }
    const bool is_steered = scene.acts == Acts::kVectors || scene.acts == Acts::kHeadings;
    const Play play = scene.acts == Acts::kVectors ? Play::kVectorEachTick : Play::kHeadingEachTick;
    EnergyWatch watch(*world,
                      scene.acts == Acts::kNothing && scene.contact == state::SurfaceContact::kBilateral);
    const long ticks = std::lround(seconds * rate);
    for (long tick = 0; tick < ticks && watch.not_finite() == 0; ++tick) {
      if (is_steered) {
        play_on(*world, play, rate, static_cast<std::uint64_t>(tick), 1);
      } else {
        world->step();
      }
      watch.look();
    }
    if (!(watch.gained() <= found.gained)) {
      found.gained = watch.gained();
      found.at_rate = rate;
    }
    found.lost = std::fmax(found.lost, watch.lost());
    found.capped = std::fmax(
        found.capped, static_cast<double>(world->counters().capped) /
                          static_cast<double>(std::max<std::uint64_t>(1, world->counters().sub_steps)));
    found.not_finite += static_cast<double>(watch.not_finite());
    found.outside += static_cast<double>(watch.outside());
  }
  return found;
}

/// A square for each method and (force, contact): the worst of the maps.
std::string picture(const Table& table) {
  const std::size_t rows = kActs.size() * kContacts.size();
  std::vector<double> worst(rows * kIntegrators.size(), 1e-16);
  const auto place = [](const auto& all, const auto& text) {
    std::size_t i = 0;
    while (i < all.size() && text != all[i]) ++i;
    return i;
  };
  for (const auto& row : table.rows()) {
    const auto text = [&](std::size_t i) { return std::get<std::string>(row[i]); };
    const std::size_t force = place(kActNames, text(1));
    const std::size_t contact = text(2) == state::to_text(kContacts[0]) ? 0 : 1;
    const auto method = static_cast<std::size_t>(
        std::find(kIntegrators.begin(), kIntegrators.end(), *integrator_from_text(text(3))) -
        kIntegrators.begin());
    double& w = worst[(2 * force + contact) * kIntegrators.size() + method];
    w = std::fmax(w, std::get<double>(row[4]));
  }
  std::ostringstream script, labels;
  script << "set termoption noenhanced\n$map << EOD\n";
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < kIntegrators.size(); ++column) {
      const double value = worst[row * kIntegrators.size() + column];
      script << column << ' ' << row << ' ' << std::clamp(std::log10(value), -12.0, 2.0) << '\n';
      std::array<char, 16> text{};
      std::snprintf(text.data(), text.size(), "%.0e", value);
      labels << "set label '"
             << (value > 1e99     ? "lost"
                 : value <= 1e-15 ? "0"
                                  : text.data())
             << "' at " << column << ',' << row << " center front font ',9' tc rgb '"
             << (value > 0.1 ? "#ffffff" : "#000000") << "'\n";
    }
    script << '\n';
  }
  script << "EOD\n"
         << labels.str()
         << "set title 'Energy that nobody gave, of that above the lowest place: the worst of the shipped "
            "maps, 15 to 1000 Hz'\n"
         << "set cblabel 'log10' offset 1,0\nset cbrange [-12:2]\nset palette defined (-12 '#1a6faf', -6 "
            "'#7fc4a0', -4 "
            "'#f4f0a0', -2 '#f08030', 0 '#b01020', 2 '#000000')\n"
         << "set xrange [-0.5:" << kIntegrators.size() << "-0.5]\nset yrange [-0.5:" << rows
         << "-0.5]\nset tics nomirror out\nset xtics rotate by 30 right (";
  for (std::size_t i = 0; i < kIntegrators.size(); ++i)
    script << (i == 0 ? "" : ",") << "'" << to_text(kIntegrators[i]) << "' " << i;
  script << ") noenhanced\nset ytics (";
  for (std::size_t i = 0; i < rows; ++i)
    script << (i == 0 ? "" : ",") << "'" << kActNames[i / 2] << ", " << state::to_text(kContacts[i % 2])
           << "' " << i;
  script << ")\nplot $map using 1:2:3 with image notitle\n";
  return script.str();
}

}  // namespace

core::Expected<void> measure_game_stability(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const bool quick = output.quick;
  const std::vector<int> rates = quick ? std::vector<int>{15, 120} : std::vector<int>{15, 60, 240, 1000};
  const double seconds = quick ? 1.0 : 10.0;
  const std::size_t lice = quick ? 4 : 8;
  Table table({"map", "acts", "contact", "integrator", "gained", "at_rate", "lost", "capped", "not_finite",
               "outside"});
  Table worst(
      {"integrator", "acts", "contact", "gained", "on", "at_rate", "capped", "not_finite", "outside"});
  std::vector<Scene> scenes;
  for (const auto& map : *maps) {
    for (const Acts acts : kActs) {
      for (const state::SurfaceContact contact : kContacts) {
        const bool has_both =
            contact == state::SurfaceContact::kUnilateral && map->definition.physics.central_gravity > 0.0;
        if (is_measured(*map) && !has_both)
          scenes.push_back({*map, acts, contact});  // none flies round a centre
      }
    }
  }
  std::vector<std::array<std::optional<Found>, kIntegrators.size()>> all(scenes.size());
  Progress progress("stability on maps", scenes.size());
  side_by_side(
      scenes.size(),
      [&](std::size_t i) {
        for (std::size_t m = 0; m < kIntegrators.size(); ++m)
          all[i][m] = run(scenes[i], kIntegrators[m], rates, seconds, lice);
      },
      [&] { progress.advance(); });
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (std::size_t m = 0; m < kIntegrators.size(); ++m) {
      const auto& found = all[i][m];
      if (!found) continue;
      table.add(
          {scenes[i].map.definition.name, std::string(kActNames[static_cast<std::size_t>(scenes[i].acts)]),
           std::string(state::to_text(scenes[i].contact)), std::string(to_text(kIntegrators[m])),
           found->gained, found->at_rate, found->lost, found->capped, found->not_finite, found->outside});
    }
  }
  for (const Integrator integrator : kIntegrators) {
    for (const char* const acts : kActNames) {
      for (const state::SurfaceContact contact : kContacts) {
        const std::vector<Table::Cell>* most = nullptr;
        double capped = 0.0, not_finite = 0.0, outside = 0.0;
        for (const auto& row : table.rows()) {
          if (std::get<std::string>(row[1]) != acts ||
              std::get<std::string>(row[2]) != state::to_text(contact) ||
              std::get<std::string>(row[3]) != to_text(integrator))
            continue;
          if (most == nullptr || std::get<double>(row[4]) > std::get<double>((*most)[4])) most = &row;
          capped = std::fmax(capped, std::get<double>(row[7]));
          not_finite += std::get<double>(row[8]);
          outside += std::get<double>(row[9]);
        }
        if (most == nullptr) continue;
        worst.add({std::string(to_text(integrator)), std::string(acts), std::string(state::to_text(contact)),
                   (*most)[4], (*most)[0], (*most)[5], capped, not_finite, outside});
      }
    }
  }
  std::cout << "\nThe shipped maps, " << seconds << " s, " << lice
            << " lice: energy that nobody gave, the worst of the maps\n";
  worst.print(std::cout);
  if (auto done = output.write(table, "lab-stability-maps"); !done) return done;
  return output.draw(picture(table), "lab-stability-maps", 980, 560);
}

}  // namespace woodlouse::lab
