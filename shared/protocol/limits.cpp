#include "shared/protocol/limits.h"

#include <array>

namespace woodlouse::protocol {
namespace {

constexpr std::uint32_t kMany = 1'000'000;
constexpr std::uint32_t kDay = 86'400;
constexpr std::uint32_t kMostBytes = 1u << 30;

constexpr std::array kFields = {
    LimitField{"line", &Limits::line, 1, kMostBytes, "bytes", "longest line to the server, newline excluded",
               true, false},
    LimitField{"depth", &Limits::depth, 1, 64, "", "deepest nesting", true, false},
    LimitField{"messages_per_s", &Limits::messages_per_s, 1, kMany, "1/s",
               "messages of a session, sustained; above it they are dropped with `rate_limited`", true},
    LimitField{"burst", &Limits::burst, 1, kMany, "messages", "that may come at once", true},
    LimitField{"outbox_bytes", &Limits::outbox_bytes, 1024, kMostBytes, "bytes",
               "of answers and events waiting for a client that does not read", true},
    LimitField{"handshake_s", &Limits::handshake_s, 1, kDay, "s", "in which the `join` must come", true},
    LimitField{"idle_s", &Limits::idle_s, 1, kDay, "s",
               "without a byte either way before `idle`; a silent watcher stays, because frames reach it",
               true},
    LimitField{"per_address", &Limits::per_address, 1, kMany, "", "connections of one address", true},
    LimitField{"per_room", &Limits::per_room, 1, kMany, "",
               "sessions in a room: `max_players`, `max_bots` and `max_spectators` together", true, false},
    LimitField{"max_connections", &Limits::max_connections, 1, kMany, "",
               "connections of the server; the last 5 % are for addresses that have none"},
    LimitField{"max_players", &Limits::max_players, 0, kMany, "",
               "players in a room; the last 5 % of this and the next two are for addresses that have nobody "
               "there"},
    LimitField{"max_bots", &Limits::max_bots, 0, kMany, "", "bots in a room, the house's apart"},
    LimitField{"max_spectators", &Limits::max_spectators, 0, kMany, "", "spectators in a room"},
    LimitField{"layouts_per_address", &Limits::layouts_per_address, 0, kMany, "",
               "choices of columns that a room encodes for one address, the common ones apart"},
    LimitField{"inputs_per_tick", &Limits::inputs_per_tick, 1, 256, "",
               "inputs of a player that one step takes; one more takes the last one's place, or is dropped "
               "where that has waited for a step already"},
    LimitField{"frame_rows", &Limits::frame_rows, 1, kEveryRow, "",
               "rows of a frame; where a room has more lice, each client is shown those nearest to its own"},
    LimitField{"chat_per_s", &Limits::chat_per_s, 0, kMany, "1/s", "chat of a session"},
    LimitField{"chat_per_s_address", &Limits::chat_per_s_address, 0, kMany, "1/s", "chat of an address"},
    LimitField{"chat_per_s_room", &Limits::chat_per_s_room, 0, kMany, "1/s", "chat of a room"},
    LimitField{"respawn_per_s", &Limits::respawn_per_s, 0, kMany, "1/s", "respawns of a session"},
    LimitField{"respawn_per_s_address", &Limits::respawn_per_s_address, 0, kMany, "1/s",
               "respawns of an address"},
    LimitField{"respawn_per_s_room", &Limits::respawn_per_s_room, 0, kMany, "1/s", "respawns of a room"},
    LimitField{"join_per_s_address", &Limits::join_per_s_address, 0, kMany, "1/s", "joins of an address"},
    LimitField{"join_per_s_room", &Limits::join_per_s_room, 0, kMany, "1/s",
               "players' and bots' joins of a room"},
    LimitField{"line_bytes_per_s", &Limits::line_bytes_per_s, 1024, kMostBytes, "bytes/s",
               "of lines of a session; what exceeds it is read later, and nothing of it dropped"},
    LimitField{"line_bytes_per_s_address", &Limits::line_bytes_per_s_address, 1024, kMostBytes, "bytes/s",
               "the same for an address"},
    LimitField{
        "answer_bytes_per_s", &Limits::answer_bytes_per_s, 1024, kMostBytes, "bytes/s",
        "of answers to `get_map`, `resync`, `list`, `list_records` and `get_ghost` for a session; what "
        "exceeds it is answered later, a `list` with `rate_limited`"},
    LimitField{"answer_bytes_per_s_address", &Limits::answer_bytes_per_s_address, 1024, kMostBytes, "bytes/s",
               "the same for an address"},
    LimitField{"ping_s", &Limits::ping_s, 1, kDay, "s", "between two `ping` of the server"},
    LimitField{"vacant_s", &Limits::vacant_s, 1, kDay, "s",
               "without a word of who has answered one before, or without a sign of its system, before a "
               "louse's thrust ends"},
    LimitField{"resume_s", &Limits::resume_s, 0, kDay, "s",
               "for which a louse waits for a player who is to come back"},
};

}  // namespace

std::span<const LimitField> limit_fields() { return kFields; }

}  // namespace woodlouse::protocol
