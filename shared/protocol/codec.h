// Lines to messages and back. Every range of every field is checked here, once; what passes is trusted.
//
// Strict where JSON is loose: no NaN or Inf, no duplicate keys, no fraction where an integer is meant, valid
// UTF-8, nesting of at most kMaxDepth. Unknown fields are passed over; an unknown type is an error.
// Thrust is rounded to 1/128, clamped to range, the clamping told. Names and chat lose their control
// characters. Thread safe: no state.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/json/text.h"
#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

/// Why a line was refused: `code` is of the table in docs/protocol.md, `text` says what, where, what to do.
struct DecodeError {
  std::string code;
  std::string text;
  bool is_json = true;  ///< false: not JSON at all (three such lines running end a connection)
};

tl::expected<ClientMessage, DecodeError> decode_client(std::string_view line);

/// Server messages. `fields` and `format` are the Welcome's, for rows; ignored for other messages. A type, or
/// an event's kind, of a later version has the code unknown_type: pass over it.
tl::expected<ServerMessage, DecodeError> decode_server(std::string_view line,
                                                       const std::vector<Column>& fields, Format format);

/// One line each, newline included.
std::string encode(const ClientMessage& message);
/// REQUIRES no Frame: those are written once for all who see them (server/frames/frame_encoder.h).
std::string encode(const ServerMessage& message);
/// As encode(), onto `out`. An ack allocates nothing where it has room.
void append(std::string& out, const ServerMessage& message);

inline constexpr std::size_t kValueRoom = 40;
/// A column's value of a row, given in units (m, m/s, rad), as text at `to`, which has room for
/// kValueRoom: the nearest multiple of its quantum, as that integer (of two as near, the even one), or
/// the shortest double that reads back the same. Returns the end. REQUIRES a finite value, below 2^53 quanta.
char* write_value(char* to, double value, Column column, Format format);
/// The same of a quantized row. per_quantum: 1 / quantum(column), exact.
inline char* write_quantized(char* to, double value, double per_quantum) {
  const double steps = value * per_quantum;
  assert(std::abs(steps) <= static_cast<double>(kMaxInteger));
  return json::write_integer(to, std::llrint(steps));  // one instruction where there is one
}

}  // namespace woodlouse::protocol
