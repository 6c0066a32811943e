// What each client of a swarm is and does; made of the options before any of them connects.
#pragma once

#include <boost/asio/ip/address_v4.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/swarm/options.h"

namespace woodlouse::swarm {

enum class Task {
  kWatch,  ///< sends nothing
  kSteer,  ///< random inputs
  kChat,
  kAsk,   ///< what options.ask names, as fast as the limits allow
  kFile,  ///< options.inputs_per_tick inputs for one tick, as often as the limits allow
};

struct Profile {
  Task task = Task::kSteer;
  protocol::Role role = protocol::Role::kBot;
  std::string name;
  std::string room;
  std::optional<boost::asio::ip::address_v4> from;  ///< what the socket is bound to
  double per_second = 0.0;                          ///< what it sends, steering or chatting
  bool stalls = false;                              ///< reads nothing any more once it has joined
  bool vanishes = false;                            ///< breaks its connection once it has joined
  bool resumes = false;                             ///< joins so that it may come back
};

/// The load: bots, spectators, chatters, askers, in this order.
std::vector<Profile> load_profiles(const Options& options);
/// Those that are measured apart from it.
std::vector<Profile> healthy_profiles(const Options& options);
/// One of those that come and vanish.
Profile churn_profile(const Options& options, std::size_t number);

/// 127.0.0.1 for 0, then 127.0.0.2 ...: 250 to a third byte.
boost::asio::ip::address_v4 loopback(std::size_t number);

}  // namespace woodlouse::swarm
