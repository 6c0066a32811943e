// What the player has set and opened: the view, labels, trails, what lies over the game. Pure: actions in,
// state out. The louse itself is the pilot's.
#pragma once

#include <cstdint>

#include "client/controls/driving.h"
#include "client/controls/key_bindings.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

enum class TrailLength : std::uint8_t { kOff, kShort, kLong };

struct Interface {
  View view = View::kMap;
  bool has_chosen = false;  ///< the view is the player's choice, no longer what suits the terminal
  bool has_oblique = true;  ///< the look shows it otherwise than the map; else V passes it over
  double zoom = 1.0;        ///< of View::kFollow; zoomed out beyond kFarthest it is the map again
  Overlay overlay = Overlay::kNone;
  bool chatting = false;
  SteerBy steer = SteerBy::kHeading;
  bool labels = true;
  TrailLength trails = TrailLength::kLong;
  bool error = false;           ///< how far the steps err is asked for
  std::uint32_t follow_id = 0;  ///< whom a spectator follows; 0: the leader

  static constexpr double kNearest = 4.0;
  static constexpr double kFarthest = 0.5;
  static constexpr double kZoomStep = 1.25;

  /// This view suits the terminal best now: where the player has chosen none, it is taken.
  void suit(View best) {
    if (!has_chosen) view = best;
  }
  /// Carries out what concerns only the picture; false for actions that are somebody else's.
  bool apply(Action action);
};

}  // namespace woodlouse::client
