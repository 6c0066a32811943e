// Who has come and must go again: what he is told, and how it is counted.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <optional>

#include "server/net/connection_limits.h"
#include "server/net/session.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Loopback, also as IPv6 has it of IPv4.
[[nodiscard]] bool is_of_this_machine(const boost::asio::ip::address& address);

/// A fatal error for somebody of that address; none: he is welcome. Any thread.
std::optional<protocol::ErrorMessage> why_turned_away(const SessionEnvironment& environment,
                                                      ConnectionLimits::Admission admission,
                                                      const boost::asio::ip::address& address);

}  // namespace woodlouse::server
