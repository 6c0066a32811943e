// Clients that are measured together, and what they got in all.
#pragma once

#include <boost/asio/io_context.hpp>

#include <memory>
#include <vector>

#include "bench/swarm/bot.h"

namespace woodlouse::swarm {

using Bots = std::vector<std::unique_ptr<Bot>>;

Bots make_bots(boost::asio::io_context& context, const Options& options, std::vector<Profile> profiles);
std::size_t count(const Bots& bots, Bot::State state);

}  // namespace woodlouse::swarm
