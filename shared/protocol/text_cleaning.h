// Makes a text that a stranger wrote safe to show on a terminal: names, chat, and what a server says.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace woodlouse::protocol {

/// Without what is not printable (core/printable.h); blanks and line ends become single spaces, none at
/// either end; of marks over one character two stay; cut to `max_bytes` between two characters. Bytes that
/// are not UTF-8 are left out. May be empty. Cleaning twice changes nothing.
std::string clean_text(std::string_view text, std::size_t max_bytes);

}  // namespace woodlouse::protocol
