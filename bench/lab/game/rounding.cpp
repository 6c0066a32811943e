#include "bench/lab/game/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/methods/steps.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::lab {
namespace {

constexpr double kGravity = 9.81;
constexpr std::size_t kStarts = 4;
constexpr std::array kRates = {60, 1000};

/// z = x^2/5 + y^2/7 + x^2 y/100: no louse of these meets a line of knots, so that nothing but the method and
/// rounding is seen; and nothing repeats after a round.
template <typename T>
struct Bowl {
  T z, zx, zy, zxx, zxy, zyy;
  Bowl(T x, T y)
      : z(x * x / T(5) + y * y / T(7) + x * x * y / T(100)),
        zx(T(2) * x / T(5) + x * y / T(50)),
        zy(T(2) * y / T(7) + x * x / T(100)),
        zxx(T(2) / T(5) + y / T(50)),
        zxy(x / T(50)),
        zyy(T(2) / T(7)) {}
};

template <typename T>
struct Moving {
  T x, y, vx, vy;
};

template <typename T>
std::array<T, 2> acceleration(T x, T y, T vx, T vy) {
  const Bowl<T> b(x, y);
  const T s = (T(kGravity) + (b.zxx * vx + T(2) * b.zxy * vy) * vx + b.zyy * vy * vy) /
              (T(1) + b.zx * b.zx + b.zy * b.zy);
  return {-s * b.zx, -s * b.zy};
}

template <typename T>
T energy(const Moving<T>& m) {
  const Bowl<T> b(m.x, m.y);
  const T rise = b.zx * m.vx + b.zy * m.vy;
  return T(0.5) * (m.vx * m.vx + m.vy * m.vy + rise * rise) + T(kGravity) * b.z;
}

/// Kutta's method on (x, v).
template <typename T>
Moving<T> kutta(const Moving<T>& m, T h) {
  const auto slope = [](const Moving<T>& at) {
    const auto a = acceleration(at.x, at.y, at.vx, at.vy);
    return Moving<T>{at.vx, at.vy, a[0], a[1]};
  };
  const auto on = [&](const Moving<T>& d, T t) {
    return Moving<T>{m.x + t * d.x, m.y + t * d.y, m.vx + t * d.vx, m.vy + t * d.vy};
  };
  const Moving<T> a = slope(m), b = slope(on(a, h / T(2))), c = slope(on(b, h / T(2))), d = slope(on(c, h));
  const auto sum = [&](T p, T q, T r, T s) { return h / T(6) * (p + T(2) * (q + r) + s); };
  return {m.x + sum(a.x, b.x, c.x, d.x), m.y + sum(a.y, b.y, c.y, d.y), m.vx + sum(a.vx, b.vx, c.vx, d.vx),
          m.vy + sum(a.vy, b.vy, c.vy, d.vy)};
}

std::vector<Moving<double>> starts() {
  core::Random random(9);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  std::vector<Moving<double>> result;
  for (std::size_t i = 0; i < kStarts; ++i)
    result.push_back({1.0 + symmetric(1.0), symmetric(2.0), symmetric(3.0), symmetric(3.0)});
  return result;
}

/// After 10^3, 10^4 ... steps the root of the mean square over all starts of the energy's error, of the
/// start's.
using Growth = std::vector<std::pair<double, double>>;

/// step(k): moves louse k on; told(k): its energy.
Growth growth(double most, const std::function<void(std::size_t)>& step,
              const std::function<long double(std::size_t)>& told) {
  Growth result;
  std::array<long double, kStarts> first;
  for (std::size_t k = 0; k < kStarts; ++k) first[k] = told(k);
  double next = 1000.0;
  for (double steps = 1.0; steps <= most; ++steps) {
    for (std::size_t k = 0; k < kStarts; ++k) step(k);
    if (steps < next * (1.0 - 1e-9)) continue;
    long double sum = 0;
    for (std::size_t k = 0; k < kStarts; ++k) {
      const long double error = (told(k) - first[k]) / first[k];
      sum += error * error;
    }
    result.emplace_back(steps, static_cast<double>(std::sqrt(sum / kStarts)));
    next *= std::sqrt(10.0);
  }
  return result;
}

Growth growth_of_kutta(double most, int rate) {
  std::vector<Moving<long double>> lice;
  for (const Moving<double>& m : starts()) lice.push_back({m.x, m.y, m.vx, m.vy});
  const long double h = 1.0L / rate;
  return growth(
      most, [&](std::size_t k) { lice[k] = kutta(lice[k], h); },
      [&](std::size_t k) { return energy(lice[k]); });
}

/// What double's rounding alone does: the energy by Kutta's method in double, less that of the same in long
/// double.
Growth growth_of_rounding(double most, int rate) {
  std::vector<Moving<double>> lice = starts();
  std::vector<Moving<long double>> exact;
  for (const Moving<double>& m : lice) exact.push_back({m.x, m.y, m.vx, m.vy});
  const std::vector<Moving<long double>> first = exact;
  return growth(
      most,
      [&](std::size_t k) {
        lice[k] = kutta(lice[k], 1.0 / rate);
        exact[k] = kutta(exact[k], 1.0L / rate);
      },
      [&](std::size_t k) {
        const Moving<long double> rounded{lice[k].x, lice[k].y, lice[k].vx, lice[k].vy};
        return energy(first[k]) + (energy(rounded) - energy(exact[k]));
      });
}

/// The server's steps over the spline through the bowl, which is the bowl: it is a cubic. All happens in one
/// cell.
Growth growth_of_steps(double most, int rate, Integrator integrator) {
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 5;
  grid.x_origin = grid.y_origin = -12;
  grid.dx = grid.dy = 8;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) grid.heights.push_back(Bowl<double>(-12.0 + 8 * i, -12.0 + 8 * j).z);
  }
  const terrain::BicubicSpline spline(grid);
  state::Parameters p{kGravity, 0.0, 0.0, 0.0, 1.0};
  const physics::StepRules rules{p, kNowhere, 1.0 / rate};
  const Steps steps = exact_steps(spline, integrator, rules);
  std::vector<state::Louse> lice;
  for (const Moving<double>& m : starts()) lice.push_back(louse_at({m.x, m.y}, {m.vx, m.vy}));
  const std::vector<std::uint32_t> one{0};
  physics::BatchLists lists;
  physics::StepCounters counters;
  std::vector<state::StepEvents> events(1);
  return growth(
      most,
      [&](std::size_t k) {
        steps->advance({&lice[k], 1}, one, {}, lists, counters, events);
      },
      [&](std::size_t k) {
        const state::Louse& louse = lice[k];
        return energy(
            Moving<long double>{louse.position.x, louse.position.y, louse.velocity.x, louse.velocity.y});
      });
}

/// The slope over the last two decades, in logarithms.
double exponent(const Growth& growth) {
  const auto& last = growth.back();
  const auto& before = growth[growth.size() >= 5 ? growth.size() - 5 : 0];
  return std::log(last.second / before.second) / std::log(last.first / before.first);
}

std::string picture(const std::vector<std::pair<std::string, Growth>>& all) {
  constexpr std::array<const char*, 7> kColours = {"#0072B2", "#E69F00", "#009E73", "#CC79A7",
                                                   "#56B4E9", "#D55E00", "#444444"};
  std::ostringstream script, plots;
  script << "set logscale xy\nset format '10^{%L}'\nset grid lc rgb '#dddddd'\nset key outside right\n"
         << "set xlabel 'steps'\nset ylabel 'error of the energy, of it'\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    script << '$' << name << " << EOD\n";
    for (const auto& [steps, error] : all[i].second) script << steps << ' ' << std::max(error, 1e-19) << '\n';
    script << "EOD\n";
    plots << '$' << name << " with linespoints lw 1.5 pt " << 4 + i / 2 << " ps 0.6 lc rgb '"
          << kColours[(i / 2) % kColours.size()] << "' dt " << 1 + i % 2 << " title '" << all[i].first
          << "' noenhanced, ";
  }
  script << "plot " << plots.str()
         << "1.1e-16*sqrt(x) with lines lc rgb 'black' dt 3 title 'rounding, sqrt(t)'\n";
  return script.str();
}

}  // namespace

core::Expected<void> measure_rounding(const Output& output) {
  const double most = output.quick ? 1e4 : 1e7;
  using Run = std::function<Growth(int)>;
  const std::vector<std::pair<std::string, Run>> runs = {
      {"default", [&](int rate) { return growth_of_steps(most, rate, Integrator::kNystrom4); }},
      {"verlet_q", [&](int rate) { return growth_of_steps(most, rate, Integrator::kVerletQ); }},
      {"dopri5", [&](int rate) { return growth_of_steps(most, rate, Integrator::kDormandPrince5); }},
      {"rk4, long double", [&](int rate) { return growth_of_kutta(most, rate); }},
      {"rk4, rounding alone", [&](int rate) { return growth_of_rounding(most, rate); }}};
  Table table({"method", "rate", "steps", "energy_error"});
  Table summary({"method", "rate", "error_1e3", "at_the_end", "exponent"});
  std::vector<std::pair<std::string, Growth>> drawn;
  std::vector<Growth> grown(runs.size() * kRates.size());
  Progress progress("rounding", grown.size());
  side_by_side(
      grown.size(),
      [&](std::size_t i) {
        const std::size_t k = grown.size() - 1 - i;  // the longest first
        grown[k] = runs[k / kRates.size()].second(kRates[k % kRates.size()]);
      },
      [&] { progress.advance(); });
  for (std::size_t k = 0; k < grown.size(); ++k) {
    const std::string& name = runs[k / kRates.size()].first;
    const int rate = kRates[k % kRates.size()];
    Growth& growth = grown[k];
    for (const auto& [steps, error] : growth) table.add({name, static_cast<double>(rate), steps, error});
    summary.add(
        {name, static_cast<double>(rate), growth.front().second, growth.back().second, exponent(growth)});
    drawn.emplace_back(name + ", " + std::to_string(rate) + " Hz", std::move(growth));
  }
  std::cout << "\nThe energy of " << kStarts << " lice in a bowl after " << most
            << " steps; exponent: 0.5 is a walk by chance, 1 a trend\n";
  summary.print(std::cout);
  if (auto done = output.write(table, "lab-rounding"); !done) return done;
  return output.draw(picture(drawn), "lab-rounding", 860, 480);
}

}  // namespace woodlouse::lab
