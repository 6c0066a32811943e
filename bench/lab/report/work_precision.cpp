#include "bench/lab/report/work_precision.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>

namespace woodlouse::lab {
namespace {

/// As many as there are methods in one picture.
constexpr std::array kColours = {"#9400d3", "#009e73", "#56b4e9", "#e69f00", "#c8b400", "#0072b2",
                                 "#e51e10", "#000000", "#8b8b8b", "#a0522d", "#ff69b4"};

}  // namespace

std::string work_precision_picture(const std::vector<Panel>& panels) {
  constexpr double kLowest = 1e-14;
  std::ostringstream script;
  script << "set logscale xy\nset format x '10^{%L}'\nset format y '10^{%L}'\nset grid\nset key left bottom "
            "font ',9'\n"
         << "set xlabel 'ns per simulated second'\nset yrange [" << kLowest << ":10]\n"
         << "set multiplot layout 1," << panels.size() << "\nset xrange [1e3:1e7]\n";
  for (const Panel& panel : panels) {
    std::ostringstream plots;
    std::size_t index = 0;  // a method keeps its colour in every panel
    for (const Curve& curve : panel.curves) {
      ++index;
      std::ostringstream points;
      for (const auto& [time, error] : curve.points) {
        if (error < 10.0) points << time << ' ' << std::max(error, kLowest) << '\n';
      }
      if (points.str().empty()) continue;
      const std::string block = "$d" + std::to_string(index);
      script << block << " << EOD\n" << points.str() << "EOD\n";
      plots << (plots.str().empty() ? "plot " : ", ") << block << " with linespoints lw 1.5 lc rgb '"
            << kColours[(index - 1) % kColours.size()] << "' pt " << index + 3 << " ps 0.6 title '"
            << curve.name << "' noenhanced";
    }
    script << "set title '" << panel.title << "' noenhanced\nset ylabel '" << panel.error << "'\n"
           << plots.str() << '\n';
  }
  return script.str() + "unset multiplot\n";
}

}  // namespace woodlouse::lab
