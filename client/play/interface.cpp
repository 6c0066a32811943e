#include "client/play/interface.h"

#include <algorithm>

namespace woodlouse::client {
namespace {

View after(View view, bool has_oblique) {
  switch (view) {
    case View::kMap:
      return has_oblique ? View::kOblique : View::kFollow;
    case View::kOblique:
      return View::kFollow;
    case View::kFollow:
      return View::kSlope;
    case View::kSlope:
      return View::kMap;
  }
  return View::kMap;
}

TrailLength after(TrailLength trails) {
  switch (trails) {
    case TrailLength::kLong:
      return TrailLength::kOff;
    case TrailLength::kOff:
      return TrailLength::kShort;
    case TrailLength::kShort:
      return TrailLength::kLong;
  }
  return TrailLength::kLong;
}

void zoom_in(Interface& interface) {
  interface.zoom = interface.view == View::kFollow
                       ? std::min(interface.zoom * Interface::kZoomStep, Interface::kNearest)
                       : 1.0;
  interface.view = View::kFollow;
  interface.has_chosen = true;
}

void zoom_out(Interface& interface) {
  if (interface.view != View::kFollow) return;
  interface.has_chosen = true;
  interface.zoom /= Interface::kZoomStep;
  if (interface.zoom >= Interface::kFarthest) return;
  interface.view = View::kMap;
  interface.zoom = 1.0;
}

}  // namespace

bool Interface::apply(Action action) {
  switch (action) {
    case Action::kView:
      view = after(view, has_oblique);
      has_chosen = true;
      return true;
    case Action::kZoomIn:
      zoom_in(*this);
      return true;
    case Action::kZoomOut:
      zoom_out(*this);
      return true;
    case Action::kLabels:
      labels = !labels;
      return true;
    case Action::kTrails:
      trails = after(trails);
      return true;
    case Action::kError:
      error = !error;
      return true;
    case Action::kSteer:
      steer = steer == SteerBy::kHeading ? SteerBy::kCompass : SteerBy::kHeading;
      return true;
    case Action::kScoreboard:
      overlay = overlay == Overlay::kScoreboard ? Overlay::kNone : Overlay::kScoreboard;
      return true;
    case Action::kHelp:
      overlay = Overlay::kHelp;
      return true;
    case Action::kAskQuit:
      overlay = Overlay::kQuitQuestion;
      return true;
    case Action::kClose:
      overlay = Overlay::kNone;
      return true;
    case Action::kChat:
      chatting = true;
      return true;
    default:
      return false;
  }
}

}  // namespace woodlouse::client
