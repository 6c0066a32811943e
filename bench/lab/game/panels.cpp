#include "bench/lab/game/panels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>

namespace woodlouse::lab {
namespace {

constexpr double kLowest = 1e-15, kHighest = 10.0;
constexpr std::size_t kColumns = 5;
/// Told apart without red beside green (Okabe and Ito).
constexpr std::array<const char*, 6> kColours = {"#0072B2", "#E69F00", "#009E73",
                                                 "#CC79A7", "#56B4E9", "#444444"};

std::string block(const std::string& name, const std::vector<GamePoint>& points, bool only_default) {
  std::ostringstream out;
  out << '$' << name << " << EOD\n";
  for (const GamePoint& p : points) {
    if ((!only_default || p.is_default) && p.error < kHighest)
      out << p.ns << ' ' << std::max(p.error, kLowest) << '\n';
  }
  out << "EOD\n";
  return out.str();
}

}  // namespace

std::string game_picture(const std::vector<GamePanel>& panels) {
  const std::size_t rows = (panels.size() + 1 + kColumns - 1) / kColumns;  // and the key's
  std::ostringstream script;
  script << "set logscale xy\nset format x '10^{%L}'\nset format y '10^{%L}'\nset grid lc rgb "
            "'#dddddd'\nunset key\n"
         << "set xrange [5e2:1e6]\nset yrange [1e-12:1]\nset ytics 1e3\nset tics font ',8'\n"
         << "set multiplot layout " << rows << ',' << kColumns
         << " title 'Median error after 4 s of play by thrusts over vectors [m], over ns of a louse and "
            "simulated second'\n";
  for (const GamePanel& panel : panels) {
    std::ostringstream plots;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      const auto& points = panel.curves[i].points;
      if (points.empty()) continue;
      const std::string name(1, static_cast<char>('a' + i));
      script << block(name, points, false);
      plots << (plots.str().empty() ? "plot " : ", ") << '$' << name << " with linespoints lw 1.5 lc rgb '"
            << kColours[i % kColours.size()] << "' pt " << 4 + i << " ps 0.5";
      if (std::any_of(points.begin(), points.end(), [](const GamePoint& p) { return p.is_default; })) {
        script << block(name + "d", points, true);
        plots << ", $" << name << "d with points lc rgb 'black' pt 6 lw 2 ps 2";
      }
    }
    script << "set title '" << panel.map << "' noenhanced offset 0,-0.6\n" << plots.str() << '\n';
  }
  // The key, in the place after the last panel.
  script
      << "unset title\nunset tics\nunset border\nunset grid\nset key center center reverse Left samplen 2\n";
  std::ostringstream keys;
  const auto& curves = panels.front().curves;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    keys << "NaN with linespoints lw 1.5 lc rgb '" << kColours[i % kColours.size()] << "' pt " << 4 + i
         << " title '" << curves[i].name << "' noenhanced, ";
  }
  script << "plot " << keys.str()
         << "NaN with points lc rgb 'black' pt 6 lw 2 ps 2 title 'the default, 60 Hz'\n";
  return script.str() + "unset multiplot\n";
}

}  // namespace woodlouse::lab
