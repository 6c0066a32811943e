// Work-precision diagrams: processor time per simulated second against error, one panel a problem, one curve
// a method.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace woodlouse::lab {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>>
      points;  ///< [ns per simulated second], error; what is not finite or > 10 is left out
};

struct Panel {
  std::string title;
  std::string error;  ///< what the error is, with its unit
  std::vector<Curve> curves;
};

/// A gnuplot script, for Output::draw.
std::string work_precision_picture(const std::vector<Panel>& panels);

}  // namespace woodlouse::lab
