#include "client/net/closing.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "shared/protocol/codes.h"

namespace woodlouse::client {

bool is_passing(const Closing& closing) {
  namespace code = protocol::code;
  // slow: a client of ours is slow where its line is. left: who asked to leave does not listen any more, so
  // something between us and the server ended our side.
  static constexpr std::array<std::string_view, 7> kPassing = {
      "",          code::kRateLimited, code::kTooManyConnections, code::kHandshakeTimeout, code::kIdle,
      code::kSlow, code::kLeft};
  return std::find(kPassing.begin(), kPassing.end(), closing.code) != kPassing.end();
}

}  // namespace woodlouse::client
