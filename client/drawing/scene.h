// Everything one frame shows, as plain values: filled by whoever runs the game, read by the drawing side.
// Lengths are metres, angles radians, times seconds unless a name says otherwise.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/drawing/course/course.h"
#include "client/drawing/key_labels.h"
#include "shared/core/vec2.h"
#include "shared/match/error_reading.h"
#include "shared/physics/attitude.h"
#include "shared/state/parameters.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::client {

/// For whose eyes lice are coloured (palette.h).
enum class Palette : std::uint8_t {
  kDefault,
  kDeutan,  ///< red and green look alike: deuteranopes, and protanopes nearly so
  kTritan,  ///< blue and green look alike
};

/// What the terminal can do and the player asked for: the same for a whole run.
struct Look {
  ColorMode color = ColorMode::kMono;
  GlyphSet glyphs = GlyphSet::kAscii;
  Palette palette = Palette::kDefault;
  friend constexpr bool operator==(const Look&, const Look&) = default;
};

/// How the terrain is seen.
enum class View : std::uint8_t {
  kMap,      ///< from above, the whole map
  kOblique,  ///< the whole map from a height, with light and shadow (from above where glyphs are ASCII)
  kFollow,   ///< zoomed around your louse (a spectator's: around `follow_id`)
  kSlope,    ///< from above, coloured by the length of the gradient: tests the normal vector
};

/// What lies over the play screen. A terminal that is too small shows that instead, whatever the mode.
enum class Mode : std::uint8_t {
  kPlay,
  kHelp,
  kScoreboard,
  kChatEntry,
  kQuitQuestion,
};

enum class LouseKind : std::uint8_t { kPlayer, kBot };

/// A louse as it is to be drawn now.
struct LouseMark {
  std::uint32_t id = 0;
  std::string name;  ///< UTF-8, as it came
  LouseKind kind = LouseKind::kPlayer;
  bool is_you = false;
  core::Vec2 position;            ///< [m]
  core::Vec2 heading{1.0, 0.0};   ///< unit; yours: where the next thrust goes
  core::Vec2 ahead{1.0, 0.0};     ///< unit: where it goes; of one that is as good as still its heading
  physics::Attitude attitude;     ///< physics::attitude(direction of travel, gradient)
  double speed = 0.0;             ///< [m/s]
  double above = 0.0;             ///< height over the ground under it [m], >= 0; 0: on it
  std::vector<core::Vec2> trail;  ///< points of the world, oldest first; see trail.h
  std::vector<double>
      trail_flights;  ///< height of each while it flew [m], 0 on the ground; empty: it never flew
};

/// The numbers of the side panel and the status line.
struct HudNumbers {
  double speed = 0.0;            ///< [m/s]
  double slope_degrees = 0.0;    ///< along LouseMark::ahead; uphill is positive
  double thrust = 0.0;           ///< -1..1, along the heading, acting now
  double push_seconds = 0.0;     ///< how long the thrust still acts; 0: not at all
  bool cruise = false;           ///< thrust is latched on
  double distance = 0.0;         ///< travelled [m]
  double height = 0.0;           ///< [m]
  double above = 0.0;            ///< over the ground [m]; 0: on it
  std::optional<double> rtt_ms;  ///< empty: not measured yet
  double tick_hz = 0.0;          ///< the server's, as measured or announced
  double fps = 0.0;
  int players = 0;  ///< lice in the room, bots included
  int bots = 0;     ///< of these
  int rank = 0;     ///< 1 = first; 0: none
  int spectators = 0;
  bool asks_error = false;                     ///< how far the steps err is shown
  std::optional<match::ErrorReading> error{};  ///< of the louse of these numbers; empty: not known yet
};

/// A line of the scoreboard, best first.
struct ScoreRow {
  std::uint32_t id = 0;
  std::string name;
  LouseKind kind = LouseKind::kPlayer;
  bool is_you = false;
  double distance = 0.0;  ///< travelled [m]
  double speed = 0.0;     ///< [m/s]
  int rank = 0;           ///< 1 = first; 0: nobody knows
  std::string measure{};  ///< what the mode ranks by, in words; empty: the distance
  double share = -1.0;    ///< of what wins, 0..1, as a bar; below 0: none
};

/// A line of the chat box, oldest first.
struct ChatLine {
  std::string from;  ///< empty: a notice of the game
  std::string text;
};

/// Whether what is shown is what was played: state hashes, recomputed here.
struct StateProof {
  std::uint64_t verified = 0;            ///< keys of a server, ticks of a recording
  std::optional<std::uint64_t> total;    ///< ticks of the recording; empty: a server's
  std::uint64_t hash = 0;                ///< the newest that was right
  std::optional<std::uint64_t> differs;  ///< the first tick whose hash is not what was stated
  bool cut_off = false;                  ///< the recording has no end
};

enum class EventSign : std::uint8_t { kJoined, kLeft, kRespawned, kChat };

/// Something to find again on a recording's time line.
struct EventMark {
  double seconds = 0.0;  ///< since the recording's beginning
  EventSign sign = EventSign::kJoined;
};

/// Where a recording stands.
struct ReplayBar {
  std::string file;
  bool playing = false;
  double seconds = 0.0;  ///< since its beginning
  double total_seconds = 0.0;
  double speed = 1.0;                                   ///< 1: as it was played
  std::shared_ptr<const std::vector<EventMark>> marks;  ///< null: none
};

/// What a map has besides its ground.
struct Landmarks {
  state::Edges edges = state::Edges::kWalls;  ///< what a louse meets there
  double core_radius = 0.0;                   ///< of what pulls towards (0, 0) [m]; 0: nothing does
  friend constexpr bool operator==(const Landmarks&, const Landmarks&) = default;
};

struct ConnectionLost {
  std::string reason;       ///< one line
  double seconds_left = 0;  ///< for which coming back is still tried
};

struct Scene {
  Look look;
  View view = View::kMap;
  Mode mode = Mode::kPlay;
  bool spectating = false;      ///< no louse of one's own: YOU shows the room instead
  double zoom = 1.0;            ///< of View::kFollow, 0.25..4; larger is nearer
  std::uint32_t follow_id = 0;  ///< whom View::kFollow follows when there is no louse of one's own
  bool key_up_known = false;    ///< the terminal reports key releases (the help screen says so)
  KeyLabels keys;               ///< those that rule
  bool labels = true;           ///< names beside lice where there is room

  std::string map_name;
  std::string room;
  std::shared_ptr<const terrain::Terrain> terrain;  ///< null until the map has come: "waiting for the map"
  Landmarks landmarks;
  std::vector<LouseMark> lice;  ///< ascending id
  HudNumbers hud;
  std::vector<ScoreRow> scores;
  std::vector<ChatLine> chat;  ///< the newest 50 or so
  std::string chat_entry;      ///< what is being typed, UTF-8 (Mode::kChatEntry)
  std::string notice;          ///< one line over the key line; empty: none
  Course course;               ///< what a mode of play shows besides
  std::string measured;        ///< what the scores are, for the scoreboard's title
  std::optional<double>
      silence;          ///< seconds without a word of the server's: numbers are not known; empty: it speaks
  bool paused = false;  ///< no tick passes
  std::optional<ConnectionLost> lost;  ///< empty: the line is up
  std::optional<StateProof> proof;     ///< empty: nothing is verified
  std::optional<ReplayBar> replay;     ///< a recording is watched; empty: a game
};

/// The smallest terminal that can be played on.
inline constexpr Size kSmallestSize{60, 20};

}  // namespace woodlouse::client
