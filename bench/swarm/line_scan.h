// What a line of the server says, without making a document of it: in a crowd each event comes to thousands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace woodlouse::swarm {

/// An ack's `seq`, when the line begins as the server's acks do; nothing for any other line.
std::optional<std::uint32_t> scan_ack_seq(std::string_view line);

/// Events, maps, lists of rooms, pongs: nothing a load tool would act on.
bool is_only_counted(std::string_view line);

/// A welcome as it would be in a room that is empty, so that to read it takes as long in a full one. Any
/// other line as it is.
std::string without_players(std::string_view line);

/// Whether a welcome says that it gives back the louse of a former connection.
bool says_resumed(std::string_view line);

/// A `join` line, its newline included, that asks for a token to come back with, or comes back with one.
std::string with_resume(std::string join, const std::optional<std::string>& token);

}  // namespace woodlouse::swarm
