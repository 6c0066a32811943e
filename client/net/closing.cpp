#include "client/net/closing.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "shared/protocol/codes.h"

namespace woodlouse::client {

bool is_passing(const Closing& closing) {
  namespace code = protocol::code;
  static constexpr std::array<std::string_view, 6> kPassing = {
      "",          code::kRateLimited,      code::kTooManyConnections,
      code::kIdle, code::kHandshakeTimeout, code::kSlow};  // a client of ours is slow where its line is
  return std::find(kPassing.begin(), kPassing.end(), closing.code) != kPassing.end();
}

}  // namespace woodlouse::client
