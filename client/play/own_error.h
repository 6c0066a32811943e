// How far the steps of your own louse err, while somebody asks: of the prediction's ticks, never of a room's.
//
// A tick counts once, a second after it was predicted: by then inputs are answered, and what an ack has put
// right was run again in its place (of an input that landed later than asked, all but the ticks between). The
// figure goes on over respawns, bumps and a server that stood still; with another pilot (a new session,
// another map or mode) it begins anew.
#pragma once

#include <cstddef>
#include <optional>

#include "client/play/room_view.h"
#include "shared/match/error_reading.h"

namespace woodlouse::client {

/// Counted at most in one picture, so that none waits for it (20 us a tick on most maps).
inline constexpr std::size_t kMostErrorTicks = 64;

/// Whether there is a louse whose steps this client takes, too.
bool has_error(const RoomView& room);
/// Counts on, to be called at each picture behind RoomView::update. Nothing before the first second, and
/// where has_error is false; not asked, all of it is dropped, and nothing is computed.
std::optional<match::ErrorReading> own_error(RoomView& room, bool asked);

}  // namespace woodlouse::client
