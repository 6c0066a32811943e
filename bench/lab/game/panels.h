// The maps' work-precision diagrams in one figure: a panel each.
#pragma once

#include <string>
#include <vector>

namespace woodlouse::lab {

struct GamePoint {
  double ns;        ///< of a louse and simulated second
  double error;     ///< [m]
  bool is_default;  ///< the method and rate that rooms have unless told otherwise: ringed
};

struct GameCurve {
  std::string name;
  std::vector<GamePoint> points;
};

struct GamePanel {
  std::string map;
  std::vector<GameCurve> curves;
};

/// A gnuplot script, for Output::draw.
std::string game_picture(const std::vector<GamePanel>& panels);

}  // namespace woodlouse::lab
