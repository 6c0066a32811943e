// From what the client knows to what a frame shows.
#pragma once

#include <vector>

#include "client/drawing/scene.h"
#include "client/play/chat_entry.h"
#include "client/play/interface.h"
#include "client/play/room_view.h"
#include "client/play/session.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

/// What a frame needs besides the session and the interface.
struct FrameFacts {
  Look look;
  double fps = 0.0;  ///< shown in the last second
  bool key_up_known = false;
  core::Time now{};
};

Scene build_scene(const Session& session, const Interface& interface, const ChatEntry& entry,
                  const FrameFacts& facts);

/// What every scene has, of a game or of a recording: the look, the map, the lice, whom the view follows, the
/// scores and how many they are. Numbers of a single louse, chat and mode are the caller's.
Scene picture(const Sight& sight, const Interface& interface, const FrameFacts& facts);

/// A louse of the sight; null: it is not there.
const LouseSample* sample_of(const Sight& sight, std::uint32_t id);

/// The ground below a place, which is moved onto the map.
terrain::SurfaceSample ground_under(const Sight& sight, core::Vec2 position);

/// Whom a spectator follows: the chosen one while there is one of that id, else the leader; 0: nobody.
std::uint32_t followed(const Sight& sight, std::uint32_t chosen);
/// The next one after `id` by id, round and round; 0 when there is nobody.
std::uint32_t next_louse(const Sight& sight, std::uint32_t id);
/// The one before.
std::uint32_t previous_louse(const Sight& sight, std::uint32_t id);

/// Speed, slope, way, height and rank of one louse, into `scene.hud`; nothing for an id that is not there.
void fill_louse_numbers(const Sight& sight, std::uint32_t id, Scene& scene);

/// Slope along a unit direction [degrees], uphill positive.
double slope_degrees(const terrain::SurfaceSample& ground, core::Vec2 direction);

/// Speed in space [m/s] of a map-plane velocity on this ground.
double speed_in_space(const terrain::SurfaceSample& ground, core::Vec2 velocity);

}  // namespace woodlouse::client
