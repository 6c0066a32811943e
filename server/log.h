// The server's log: on standard error, as text for people or one JSON object a line for machines.
#pragma once

#include <spdlog/logger.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace woodlouse::server {

enum class LogFormat : std::uint8_t { kText, kJson };

/// Thread safe. What is logged is formatted first, log->info(fmt::format(...)), by fmt's library: the
/// logger's own templates compile fmt again in each file that logs, five seconds each.
std::shared_ptr<spdlog::logger> make_logger(LogFormat format);

/// How a message becomes a line: whatever it holds, one of its own, and printable (core/printable.h).
std::unique_ptr<spdlog::formatter> formatter_of(LogFormat format);

/// The text as the inside of a JSON string: \uXXXX for what is not printable; bytes that are no UTF-8 become
/// '?'.
std::string json_escaped(std::string_view text);

}  // namespace woodlouse::server
