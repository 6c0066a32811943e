// What your louse is called: asked once, of who starts the game for the first time.
#pragma once

#include <istream>
#include <optional>
#include <ostream>
#include <string>

namespace woodlouse::client {

/// Asks until there is a name that a server takes; an empty line takes the suggestion. Nothing: the input has
/// ended.
std::optional<std::string> ask_for_name(const std::string& suggestion, std::istream& in, std::ostream& out);

}  // namespace woodlouse::client
