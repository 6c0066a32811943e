// What the game as text reads out: of lice, the room, the rules, the keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/controls/driving.h"
#include "client/drawing/key_labels.h"
#include "client/play/room_view.h"
#include "shared/match/error_reading.h"

namespace woodlouse::client {

namespace words {
/// "north-east" of a direction.
std::string compass(core::Vec2 direction);
/// One louse: "ada: 3.1 m east, 4.0 m north, 2.3 m/s south-west, slope -12 degrees, travelled 41 m".
std::string louse(const RoomView& room, const Present& louse);
/// What the rules of play want of you: a line or two; empty where there are none.
std::vector<std::string> goal(const RoomView& room);
/// Where they want you, from where you are, east and north; none: nowhere.
std::optional<core::Vec2> way_to_goal(const RoomView& room);
/// What is played, in words; empty where there are no rules, and until they were shown.
std::vector<std::string> rules(const RoomView& room);
/// The best three of a round that is over, and what you did; empty while none is.
std::vector<std::string> podium(const RoomView& room);
/// How far your louse's steps err.
std::string error(const match::ErrorReading& reading);
/// Why that is not known.
std::string no_error(const RoomView& room);
/// The keys that there are, for who plays and for who watches.
std::string keys(const KeyLabels& keys, SteerBy steer, bool plays);
/// The room, lice by rank: one line each, your own first.
std::vector<std::string> room(const RoomView& room);
/// Of who was here before the line was cut.
std::string what_became(const protocol::Welcome& welcome);
}  // namespace words

}  // namespace woodlouse::client
