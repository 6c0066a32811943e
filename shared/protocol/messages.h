// Every message of the wire, version 1: fields, ranges, limits. The text form is docs/protocol.md.
// Plain values: framing.h cuts lines, codec.h turns them into these and back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/protocol/columns.h"
#include "shared/protocol/game.h"
#include "shared/protocol/limits.h"
#include "shared/protocol/records.h"
#include "shared/state/louse.h"
#include "shared/state/louse_fields.h"
#include "shared/state/parameters.h"
#include "shared/state/role.h"
#include "shared/state/state_hash.h"
#include "shared/state/thrust.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::protocol {

inline constexpr int kProtocolVersion = 1;
inline constexpr std::size_t kMaxLineBytes = 4096;  ///< inbound at the server, newline excluded
inline constexpr int kMaxDepth = 8;                 ///< nesting of an inbound line
inline constexpr std::size_t kMaxNameBytes = 24;    ///< after cleaning
inline constexpr std::size_t kMaxChatBytes = 400;   ///< after cleaning
inline constexpr std::size_t kMaxRoomBytes = 80;    ///< of a room's name: a map's, its mode, a number
inline constexpr std::size_t kMaxTokenBytes = 64;   ///< of a resume_token
inline constexpr std::size_t kMaxPasswordBytes = 256;
inline constexpr std::int64_t kMaxModerateSeconds = 86'400;
inline constexpr std::size_t kMaxTextBytes =
    2048;  ///< of an error's, a notice's or a bye's text, after cleaning
inline constexpr std::uint32_t kMaxStateHz = 1000;
inline constexpr std::uint32_t kMaxThrustTicks = 0xffff'fffe;
inline constexpr std::int64_t kMaxInteger = std::int64_t{1} << 53;  ///< what every JSON reader holds exactly
inline constexpr std::size_t kMaxServerLineBytes = std::size_t{128} << 20;  ///< inbound at a client

// ---- what rows are made of, and who asks --------------------------------------------------------------

enum class Format : std::uint8_t { kQuantized, kExact };
using state::Role;
/// What a session is shown of the game: pictures, or the room's recording as it is written.
enum class Stream : std::uint8_t { kFrames, kInputs };
std::string_view to_text(Format format);
std::string_view to_text(Stream stream);
std::string_view to_text(Role role);
std::optional<Role> role_from_text(std::string_view text);

// ---- client to server ----------------------------------------------------------------------------------

/// The part of a room that a client is shown: lice within a circle, of them the nearest, and always the own.
struct View {
  std::optional<core::Vec2> place;     ///< its middle [m]; none: `louse`
  std::optional<std::uint32_t> louse;  ///< whose place is its middle; none: one's own, or the map's middle
  std::optional<double> radius;        ///< above 0 [m]; none: as far as there are lice
  std::optional<std::uint32_t> rows;   ///< at most so many, from 1; none: as many as the room allows
  /// Every louse that the room allows.
  [[nodiscard]] bool is_whole() const { return *this == View{}; }
  friend bool operator==(const View&, const View&) = default;
};

struct Join {
  int protocol = kProtocolVersion;
  Role role = Role::kPlayer;
  std::string name;            ///< cleaned, 1..kMaxNameBytes bytes of UTF-8
  std::string room;            ///< empty: the first
  std::vector<Column> fields;  ///< as asked, default_columns() when left out; the first is always id
  Format format = Format::kQuantized;
  std::optional<std::uint32_t> state_hz;  ///< frames a second; empty: the room's
  bool may_resume = false;                ///< its louse is to wait for it when the connection breaks
  std::string resume{};                   ///< the token of a louse that waits; empty: none
  std::optional<View> view{};             ///< frames show that alone; none: all
  std::string token{};                    ///< a password of the server; empty: none
  Stream stream = Stream::kFrames;        ///< kInputs: of a spectator only
  friend bool operator==(const Join&, const Join&) = default;
};

struct Input {
  std::uint32_t seq = 0;
  /// Rounded and clamped; a map vector is the pair [tx, ty] on the wire, a push along the heading a number.
  state::Thrust thrust{state::ThrustKind::kAlongHeading, {}};
  bool clamped = false;                ///< it was out of range
  std::optional<std::uint32_t> ticks;  ///< 1..2^32-2; empty: until the next input
  std::optional<std::uint64_t> tick;   ///< the step asked for
  friend bool operator==(const Input&, const Input&) = default;
};

struct Chat {
  std::string text;  ///< cleaned, 1..kMaxChatBytes
  friend bool operator==(const Chat&, const Chat&) = default;
};
struct List {
  bool watch = false;  ///< the answer comes again whenever a room has opened or closed
  friend bool operator==(const List&, const List&) = default;
};
struct GetMap {
  friend bool operator==(const GetMap&, const GetMap&) = default;
};
struct Resync {
  friend bool operator==(const Resync&, const Resync&) = default;
};
struct Respawn {
  bool at_gate = false;  ///< of a race: at the gate driven through last, as fast as then
  friend bool operator==(const Respawn&, const Respawn&) = default;
};
/// A vote for the next game of a room that plays several, one after the other.
struct Skip {
  friend bool operator==(const Skip&, const Skip&) = default;
};
/// Another view than that of the join.
struct Look {
  View view;
  friend bool operator==(const Look&, const Look&) = default;
};
/// What a moderator does about somebody in his room.
struct Moderate {
  std::string action;                    ///< of kModerateActions
  std::string who;                       ///< a name or the number of a louse; empty: of "say"
  std::string text;                      ///< of "say": cleaned, 1..kMaxChatBytes
  std::optional<std::uint64_t> seconds;  ///< of "mute"; none: as long as the connection lasts
  friend bool operator==(const Moderate&, const Moderate&) = default;
};
struct Leave {
  friend bool operator==(const Leave&, const Leave&) = default;
};
struct Ping {
  std::int64_t t = 0;  ///< within +-2^53; both directions
  /// Of a server, in place of those that its hello or a ping named; none: they are as they were.
  std::optional<std::vector<std::string>> hosts = std::nullopt;
  friend bool operator==(const Ping&, const Ping&) = default;
};
struct Pong {
  std::int64_t t = 0;
  friend bool operator==(const Pong&, const Pong&) = default;
};

using ClientMessage = std::variant<Join, Input, Chat, List, GetMap, Resync, Respawn, Skip, Look, Leave, Ping,
                                   Pong, ListRecords, GetGhost, Moderate>;

// ---- server to client ----------------------------------------------------------------------------------

struct Hello {
  int protocol = kProtocolVersion;
  int behavior = 0;
  std::string server;   ///< name and version
  std::string session;  ///< hex, for logs
  std::vector<std::string> rooms;
  std::vector<std::string> features;
  Limits limits;
  /// `host:port` of other servers at which the rooms may be found when this one is gone; on the wire where
  /// there are any.
  std::vector<std::string> hosts{};
  friend bool operator==(const Hello&, const Hello&) = default;
};

struct PlayerEntry {
  std::uint32_t id = 0;
  std::string name;
  Role role = Role::kPlayer;
  friend bool operator==(const PlayerEntry&, const PlayerEntry&) = default;
};

struct Welcome {
  std::uint32_t id = 0;      ///< the louse's; 0 for a spectator
  std::string name;          ///< yours: another one's gets a number behind it; empty: an older server
  std::string resume_token;  ///< secret, hex; empty: not asked for, or a spectator
  bool resumed = false;      ///< its token was known: the louse is the one it had
  std::string room;
  std::uint64_t tick = 0;
  std::uint32_t tick_hz = 60;
  std::uint32_t state_hz = 20;
  std::vector<Column> fields;
  Format format = Format::kQuantized;
  Stream stream = Stream::kFrames;  ///< granted; on the wire where it is kInputs
  std::string map_name;
  std::uint64_t map_hash = 0;
  std::array<double, 4> extent{};  ///< x_min, y_min, x_max, y_max [m]
  std::size_t map_bytes = 0;       ///< length of the `map` message's line
  /// On the wire: gravity, drag, friction, thrust_max, edge_restitution. The others stand in the map's
  /// definition; decoded, they are what a map has that does not name them.
  state::Parameters physics;
  std::string mode;                          ///< "roam", "race", "forage" or "hill"
  std::string rules;                         ///< of the mode, as the map has them: a JSON object; empty: roam
  std::vector<PlayerEntry> players;          ///< who is there already, spectators apart
  std::uint32_t spectators = 0;              ///< how many there are
  std::optional<std::uint32_t> view_rows{};  ///< of a frame at most; none: a server that knows no views
  friend bool operator==(const Welcome&, const Welcome&) = default;
};

/// A key or a delta, decoded. values: rows * columns numbers in the order of Welcome::fields, already in
/// units (m, m/s, rad): the quantum is applied by the decoder.
struct Frame {
  bool is_key = true;
  std::uint64_t tick = 0;
  std::uint64_t base = 0;  ///< a delta's key; a key's own tick
  std::size_t columns = 0;
  std::vector<double> values;
  std::vector<std::uint32_t> gone;       ///< ids that are in the key and no longer there
  std::optional<std::uint64_t> hash;     ///< keys only
  std::optional<state::HashLink> proof;  ///< what besides the rows went into the hash: keys of all_columns()
                                         ///< in exact format only (its tick is none after the key's)
  std::optional<Game> game;              ///< of the rules, where there are any; a delta's what has changed
  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// A louse's exact state, from which a client predicts with the same World.
struct ExactState {
  std::uint64_t tick = 0;  ///< it is the state before this step
  state::Louse louse;
  friend bool operator==(const ExactState&, const ExactState&) = default;
};

struct Ack {
  std::uint32_t seq = 0;
  std::uint64_t tick = 0;      ///< the step that took it
  std::int64_t margin_us = 0;  ///< how long before that step it came
  bool late = false;           ///< it asked for a step that was past
  bool dropped = false;        ///< it was not applied; an `error` said why
  bool clamped = false;
  std::optional<ExactState> you;  ///< after that step; none when dropped
  friend bool operator==(const Ack&, const Ack&) = default;
};

enum class EventKind : std::uint8_t {
  kJoined,
  kLeft,
  kChat,
  kRespawned,
  // Of the rules of play (shared/rules/event.h), in its order.
  kGate,
  kLapDone,
  kRun,
  kCrumb,
  kHarvest,
  kBump,
  kHolds,
  kContested,
  kMoving,
  kFell,
  kReturned,
  kRound,
  // Of the boards.
  kRecord,
  // Of the room's games.
  kSkip,
};
inline constexpr std::size_t kEventKindCount = 18;
std::string_view to_text(EventKind kind);
std::optional<EventKind> event_kind_from_text(std::string_view text);

inline constexpr std::size_t kMostEventValues = 4;
/// What an event of the rules, of the boards or of a vote carries besides: whole numbers under these names,
/// in the order of Event::values. Times are in moments, 1/65536 of a tick.
std::span<const std::string_view> value_names(EventKind kind);
constexpr bool is_of_rules(EventKind kind) { return kind >= EventKind::kGate; }

struct Event {
  std::uint64_t n = 0;  ///< numbered per room from 1, without holes
  std::uint64_t tick = 0;
  EventKind kind = EventKind::kJoined;
  std::uint32_t id = 0;  ///< whose; 0 for a spectator
  std::string name;
  Role role = Role::kPlayer;  ///< joined only
  std::string text;           ///< chat only
  // Of the rules only:
  std::uint64_t moment = 0;                                            ///< when, in moments since tick 0
  std::array<std::optional<std::int64_t>, kMostEventValues> values{};  ///< value_names(); none: null
  GamePhase phase = GamePhase::kGather;                                ///< round only: that begins
  std::vector<GameTableRow> table{};                                   ///< round only
  friend bool operator==(const Event&, const Event&) = default;
};

struct Notice {
  std::string code, text;
  friend bool operator==(const Notice&, const Notice&) = default;
};
struct ErrorMessage {
  std::string code, text;
  bool fatal = false;
  std::optional<std::uint32_t> retry_after_ms;
  std::string address{};  ///< with moved: `host:port` where the room is, unchecked; empty: not told
  friend bool operator==(const ErrorMessage&, const ErrorMessage&) = default;
};
struct Bye {
  std::string code, text;
  bool resumable = false;
  std::string address{};  ///< with moved: `host:port` where the room is, unchecked; empty: not told
  friend bool operator==(const Bye&, const Bye&) = default;
};

struct RoomEntry {
  std::string name, map;
  std::uint32_t players = 0, bots = 0, spectators = 0;
  std::string code{};     ///< by which it is joined, too; empty: not told
  std::string address{};  ///< `host:port` of the server where it is, unchecked; empty: here
  friend bool operator==(const RoomEntry&, const RoomEntry&) = default;
};
struct Rooms {
  std::vector<RoomEntry> rooms;
  friend bool operator==(const Rooms&, const Rooms&) = default;
};

inline constexpr std::size_t kMaxOverviewSide = 257;

/// The map: `definition` is a map file (maps/README.md) as a JSON object. Where its terrain names a function,
/// `knots` are that function's heights for who only draws. Where it names a file, the map is too big to be
/// sent, and `knots` are its overview: the whole domain at 4 to kMaxOverviewSide knots each way, for drawing;
/// nothing may be computed from it.
struct MapMessage {
  std::string name;
  std::uint64_t hash = 0;
  std::string definition;
  bool is_overview = false;
  std::optional<terrain::HeightGrid> knots = std::nullopt;  ///< decoded: of an overview alone
  friend bool operator==(const MapMessage&, const MapMessage&) = default;
};

using ServerMessage = std::variant<Hello, Welcome, Frame, Ack, Event, Notice, ErrorMessage, Bye, Rooms,
                                   MapMessage, Ping, Pong, Records, GhostLine>;

}  // namespace woodlouse::protocol
