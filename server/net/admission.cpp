#include "server/net/admission.h"

#include <string>
#include <utility>

#include "server/access/doorman.h"
#include "server/timing/figures.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

protocol::ErrorMessage too_many(ConnectionLimits::Admission admission, const protocol::Limits& limits) {
  const bool is_address = admission == ConnectionLimits::Admission::kAddressFull;
  return {std::string(protocol::code::kTooManyConnections),
          is_address ? "your address has " + std::to_string(limits.per_address) +
                           " connections already; close one first"
                     : "the server has " + std::to_string(limits.max_connections) +
                           " connections, the last of them for addresses that have none; try again later",
          true,
          {}};
}

std::optional<RefusedConnection> refused(ConnectionLimits::Admission admission) {
  switch (admission) {
    case ConnectionLimits::Admission::kAddressFull:
      return RefusedConnection::kAddressFull;
    case ConnectionLimits::Admission::kServerFull:
      return RefusedConnection::kServerFull;
    case ConnectionLimits::Admission::kDrop:
      return RefusedConnection::kDropped;
    case ConnectionLimits::Admission::kWelcome:
      break;
  }
  return std::nullopt;
}

}  // namespace

bool is_of_this_machine(const boost::asio::ip::address& address) {
  if (address.is_v4() || !address.to_v6().is_v4_mapped()) return address.is_loopback();
  return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, address.to_v6()).is_loopback();
}

std::optional<protocol::ErrorMessage> why_turned_away(const SessionEnvironment& environment,
                                                      ConnectionLimits::Admission admission,
                                                      const boost::asio::ip::address& address) {
  auto counted = refused(admission);
  std::optional<protocol::ErrorMessage> why;
  if (counted) why = too_many(admission, *environment.limits.now());
  if (environment.doorman != nullptr)
    if (auto banned = environment.doorman->why_not_connect(address, wall_now())) {
      why = std::move(*banned);
      counted = RefusedConnection::kBanned;
    }
  if (counted) environment.traffic.refuse(*counted);
  return why;
}

}  // namespace woodlouse::server
