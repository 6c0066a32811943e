#include "bench/swarm/profile.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

using namespace woodlouse::swarm;
using woodlouse::protocol::Role;

namespace {

template <typename Is>
long count_of(const std::vector<Profile>& profiles, Is is) {
  return std::count_if(profiles.begin(), profiles.end(), is);
}

}  // namespace

TEST_CASE("who asks for bots alone gets bots that steer, from any address") {
  Options options;
  options.bots = 3;
  const auto profiles = load_profiles(options);
  REQUIRE(profiles.size() == 3);
  CHECK(profiles[2].name == "swarm-3");
  CHECK(count_of(profiles, [](const Profile& profile) {
          return profile.task == Task::kSteer && profile.role == Role::kBot && !profile.from &&
                 !profile.stalls && !profile.resumes;
        }) == 3);
  CHECK(healthy_profiles(options).empty());
}

TEST_CASE("a crowd is bots, spectators, chatters and askers, each at its task") {
  Options options;
  options.bots = 1;
  options.spectators = 2;
  options.chatters = 3;
  options.askers = 4;
  options.inputs_per_tick = 9;
  const auto profiles = load_profiles(options);
  REQUIRE(profiles.size() == 10);
  CHECK(profiles[0].task == Task::kFile);
  CHECK(profiles[2].task == Task::kWatch);
  CHECK(profiles[5].task == Task::kChat);
  CHECK(profiles[9].task == Task::kAsk);
  CHECK(count_of(profiles, [](const Profile& profile) { return profile.role == Role::kSpectator; }) == 9);
}

TEST_CASE("addresses are taken in turns, chatters and the healthy have their own") {
  Options options;
  options.bots = 0;
  options.spectators = 1000;
  options.chatters = 2;
  options.addresses = 300;
  options.healthy = 2;
  const auto profiles = load_profiles(options);
  std::set<boost::asio::ip::address_v4> watchers;
  for (std::size_t i = 0; i < 1000; ++i) watchers.insert(*profiles[i].from);
  CHECK(watchers.size() == 300);
  CHECK(profiles[0].from == profiles[300].from);
  CHECK(profiles[1000].from == profiles[1001].from);
  CHECK(watchers.count(*profiles[1000].from) == 0);
  const auto healthy = *healthy_profiles(options)[0].from;
  CHECK(watchers.count(healthy) == 0);
  CHECK(healthy != profiles[1000].from);
  CHECK(healthy != churn_profile(options, 0).from);
  options.chatters_apart = false;
  CHECK(watchers.count(*load_profiles(options)[1000].from) == 1);
}

TEST_CASE("the n-th address is one of the loopback's, no network's and no broadcast's") {
  CHECK(loopback(0).to_string() == "127.0.0.1");
  CHECK(loopback(249).to_string() == "127.0.0.250");
  CHECK(loopback(250).to_string() == "127.0.1.1");
  CHECK(loopback(9999).to_string() == "127.0.39.250");
}

TEST_CASE("a share of the clients stalls, spread evenly") {
  for (const double percent : {0.0, 10.0, 50.0, 100.0}) {
    Options options;
    options.bots = 200;
    options.stalled_percent = percent;
    const auto profiles = load_profiles(options);
    CHECK(static_cast<double>(count_of(profiles, [](const Profile& profile) { return profile.stalls; })) ==
          2.0 * percent);
    CHECK(static_cast<double>(std::count_if(profiles.begin(), profiles.begin() + 20,
                                            [](const Profile& profile) { return profile.stalls; })) ==
          0.2 * percent);
  }
}

TEST_CASE("rooms are joined in turns") {
  Options options;
  options.bots = 4;
  options.rooms = {"a", "b"};
  const auto profiles = load_profiles(options);
  CHECK(profiles[0].room == "a");
  CHECK(profiles[1].room == "b");
  CHECK(profiles[2].room == "a");
}

TEST_CASE("the healthy steer when they are players, and churn vanishes") {
  Options options;
  options.healthy = 1;
  CHECK(healthy_profiles(options)[0].task == Task::kWatch);
  options.healthy_role = Role::kPlayer;
  CHECK(healthy_profiles(options)[0].task == Task::kSteer);
  CHECK(healthy_profiles(options)[0].per_second == kHealthyInputsPerSecond);
  CHECK(churn_profile(options, 0).vanishes);
}
