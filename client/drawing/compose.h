// From a Scene to cells: the one entry of the drawing side.
#pragma once

#include <algorithm>
#include <memory>

#include "client/cells/cell_buffer.h"
#include "client/drawing/scene.h"
#include "shared/state/mode.h"

namespace woodlouse::client {

/// How much nearer View::kFollow is than the whole map, by Scene::zoom.
constexpr double follow_zoom(double zoom) { return 2.6 * std::clamp(zoom, 0.25, 4.0); }

/// The view that suits a terminal best before anyone has chosen: oblique where there is colour, half-blocks
/// and 100x30 cells or more, there for who drives in a race near the louse, else the map. driven: by which
/// rules; roam for who looks on.
View default_view(const Look& look, Size size, state::Mode driven = state::Mode::kRoam);

/// The map's direction, a unit vector, that goes up in the middle of the picture of a view.
core::Vec2 up_in_picture(View view, const Look& look);

/// Draws scenes. Keeps what does not move (the terrain as seen by the camera) between frames, so use one for
/// a whole run. Single thread.
class Composer {
 public:
  Composer();
  ~Composer();
  Composer(const Composer&) = delete;
  Composer& operator=(const Composer&) = delete;

  /// Fills every cell of `cells`, whose size is the terminal's. Any size is drawable.
  void draw(const Scene& scene, CellBuffer& cells);

 private:
  struct Layers;
  std::unique_ptr<Layers> layers_;
};

}  // namespace woodlouse::client
