#include "client/play/outlook.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "client/drawing/compose.h"

namespace woodlouse::client {

protocol::View outlook(const Interface& interface, const std::array<double, 4>& extent, std::size_t lice) {
  assert(extent[0] < extent[2] && extent[1] < extent[3]);
  protocol::View view;
  if (lice < kCrowd || interface.view != View::kFollow || interface.overlay == Overlay::kScoreboard)
    return view;
  // The louse may be near the picture's edge: as far to the other one as the picture is wide.
  const double picture =
      std::hypot(extent[2] - extent[0], extent[3] - extent[1]) / follow_zoom(interface.zoom);
  view.radius = picture;
  return view;
}

}  // namespace woodlouse::client
