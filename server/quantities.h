// Numbers with a unit, as one types them.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::server {

/// 90m: digits and s, m, h or d. Errors: where = `option` and `text`; less than `least`, more than 10000 d.
core::Expected<std::chrono::seconds> parse_duration(const std::string& option, const std::string& text,
                                                    std::chrono::seconds least);

/// 10G: digits, and K, M, G or T for powers of 1024, bytes without. Errors: where = `option` and `text`; 0,
/// or more than 64 bits.
core::Expected<std::uint64_t> parse_bytes(const std::string& option, const std::string& text);

}  // namespace woodlouse::server
