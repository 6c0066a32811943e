// What the keys are called on the screen.
#pragma once

#include <string>

namespace woodlouse::client {

/// As short as they can be: "W", "SPC"; empty: there is none. *2: the second key.
struct KeyLabels {
  std::string up = "W", up2 = "Up", down = "S", down2 = "Down", left = "A", right = "D", brake = "X";
  std::string cruise = "SPC", respawn = "R", ghost = "G", gate = "B", chat = "T", scores = "TAB", view = "V",
              help = "?", labels = "L";
  std::string trails = "P", zoom_in = "+", zoom_out = "-", next = "N", steer = "C", error = "E", quit = "Q";
  bool compass = false;        ///< up, down, left and right push that way in the picture
  double pulse_seconds = 0.4;  ///< of a press, where releases are not known
};

}  // namespace woodlouse::client
