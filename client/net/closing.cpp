#include "client/net/closing.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "shared/protocol/codes.h"

namespace woodlouse::client {

namespace code = protocol::code;

bool is_passing(const Closing& closing) {
  // slow: a client of ours is slow where its line is. left: who asked to leave does not listen any more, so
  // something between us and the server ended our side. moved: where it leads nowhere.
  static constexpr std::array<std::string_view, 8> kPassing = {"",
                                                               code::kRateLimited,
                                                               code::kTooManyConnections,
                                                               code::kHandshakeTimeout,
                                                               code::kIdle,
                                                               code::kSlow,
                                                               code::kLeft,
                                                               code::kMoved};
  return std::find(kPassing.begin(), kPassing.end(), closing.code) != kPassing.end();
}

bool may_be_elsewhere(const Closing& closing) {
  static constexpr std::array<std::string_view, 6> kOfOneServer = {code::kUnknownRoom, code::kRoomFull,
                                                                   code::kShutdown,    code::kDraining,
                                                                   code::kBadToken,    kNoServerOfOurs};
  return std::find(kOfOneServer.begin(), kOfOneServer.end(), closing.code) != kOfOneServer.end();
}

}  // namespace woodlouse::client
