#include "bench/swarm/profile.h"

namespace woodlouse::swarm {
namespace {

using boost::asio::ip::address_v4;

// Addresses of their own, away from those of --addresses.
const address_v4 kChatters = boost::asio::ip::make_address_v4("127.1.1.1");
const address_v4 kHealthy = boost::asio::ip::make_address_v4("127.1.2.1");
const address_v4 kChurn = boost::asio::ip::make_address_v4("127.1.3.1");

std::string room_of(const Options& options, std::size_t number) {
  return options.rooms.empty() ? std::string() : options.rooms[number % options.rooms.size()];
}

/// Spread evenly: of any hundred in a row, `percent`.
bool is_of_share(std::size_t number, double percent) {
  const auto below = [percent](std::size_t count) {
    return static_cast<std::size_t>(static_cast<double>(count) * percent / 100.0 + 1e-9);
  };
  return below(number + 1) > below(number);
}

}  // namespace

address_v4 loopback(std::size_t number) {
  return address_v4(0x7F000000u + static_cast<std::uint32_t>(number / 250 * 256 + number % 250 + 1));
}

std::vector<Profile> load_profiles(const Options& options) {
  std::vector<Profile> profiles;
  const auto add = [&](std::size_t count, Profile profile) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t number = profiles.size();
      profile.name = "swarm-" + std::to_string(number + 1);
      profile.room = room_of(options, number);
      profile.from.reset();
      if (options.addresses != 0) profile.from = loopback(number % options.addresses);
      if (profile.task == Task::kChat && options.chatters_apart) profile.from = kChatters;
      profile.stalls = is_of_share(number, options.stalled_percent);
      profiles.push_back(profile);
    }
  };
  Profile bot;
  bot.task = options.inputs_per_tick != 0      ? Task::kFile
             : options.inputs_per_second > 0.0 ? Task::kSteer
                                               : Task::kWatch;
  bot.per_second = options.inputs_per_second;
  bot.resumes = options.resume;
  add(options.bots, bot);

  Profile spectator;
  spectator.role = protocol::Role::kSpectator;
  spectator.task = Task::kWatch;
  add(options.spectators, spectator);
  spectator.task = Task::kChat;
  spectator.per_second = options.chats_per_second;
  add(options.chatters, spectator);
  spectator.task = Task::kAsk;
  add(options.askers, spectator);
  return profiles;
}

std::vector<Profile> healthy_profiles(const Options& options) {
  Profile profile;
  profile.role = options.healthy_role;
  profile.task = profile.role == protocol::Role::kSpectator ? Task::kWatch : Task::kSteer;
  profile.per_second = kHealthyInputsPerSecond;
  profile.from = kHealthy;
  std::vector<Profile> profiles;
  for (std::size_t i = 0; i < options.healthy; ++i) {
    profile.name = "healthy-" + std::to_string(i + 1);
    profile.room = room_of(options, i);
    profiles.push_back(profile);
  }
  return profiles;
}

Profile churn_profile(const Options& options, std::size_t number) {
  Profile profile;
  profile.role = protocol::Role::kPlayer;
  profile.task = Task::kWatch;
  profile.name = "churn-" + std::to_string(number + 1);
  profile.room = room_of(options, number);
  profile.from = kChurn;
  profile.vanishes = true;
  return profile;
}

}  // namespace woodlouse::swarm
