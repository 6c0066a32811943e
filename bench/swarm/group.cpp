#include "bench/swarm/group.h"

#include <algorithm>

namespace woodlouse::swarm {

Bots make_bots(boost::asio::io_context& context, const Options& options, std::vector<Profile> profiles) {
  Bots bots;
  for (std::size_t i = 0; i < profiles.size(); ++i)
    bots.push_back(std::make_unique<Bot>(context, options, std::move(profiles[i]), i));
  return bots;
}

std::size_t count(const Bots& bots, Bot::State state) {
  return static_cast<std::size_t>(
      std::count_if(bots.begin(), bots.end(), [state](const auto& bot) { return bot->state() == state; }));
}

}  // namespace woodlouse::swarm
