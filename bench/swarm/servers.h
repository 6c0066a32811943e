// Where the options say the server listens, and descriptors for as many connections as the system gives.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <vector>

#include "bench/swarm/options.h"
#include "shared/core/error.h"

namespace woodlouse::swarm {

core::Expected<std::vector<boost::asio::ip::tcp::endpoint>> find_servers(boost::asio::io_context& context,
                                                                         const Options& options);
/// As many descriptors as the user may have at all.
void raise_descriptor_limit();

}  // namespace woodlouse::swarm
