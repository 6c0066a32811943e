#include "server/cluster_desk.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/net/listen_address.h"
#include "shared/core/joined.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

using core::joined;

protocol::Bye moved(const std::string& address) {
  const std::string text = address.empty() ? std::string("the room goes on elsewhere: come back")
                                           : joined({"the room is at ", address, " now"});
  return {std::string(protocol::code::kMoved), text, true, address};
}

}  // namespace

core::Expected<void> ClusterDesk::open(const ServeConfig& config, const std::string& lines,
                                       const std::string& web_url) {
  assert(!cluster_ && config.cluster);
  ClusterSettings settings = *config.cluster;
  if (settings.address.empty()) {
    settings.address = lines;
    if (config.web && !config.web->tls) {
      const auto web = parse_listen_address(
          web_url.substr(0, web_url.rfind('/')).substr(web_url.rfind("//") + 2), "--web");
      if (!web) return tl::unexpected(web.error());
      settings.address = to_text(ListenAddress{config.web->listen.host, web->port});
    }
    if (settings.address.starts_with("0.0.0.0:") || settings.address.starts_with("[::]:"))
      return core::fail("--cluster-address", "this host listens at every address: clients of others need one",
                        "as  --cluster-address 192.0.2.7:7777");
  }
  Cluster::Hooks hooks;
  hooks.take_over = [this](std::vector<RoomToGoOn> rooms) {
    boost::asio::post(strand_, [this, rooms = std::move(rooms)]() mutable { take_over(std::move(rooms)); });
  };
  hooks.step_down = [this](const std::string& elsewhere) {
    boost::asio::post(strand_, [this, elsewhere] { step_down(elsewhere); });
  };
  hooks.census = [this] { return lobby_.list().rooms; };
  auto cluster = Cluster::open(std::move(settings), std::move(hooks), log_);
  if (!cluster) return tl::unexpected(cluster.error());
  cluster_ = std::move(*cluster);
  return {};
}

protocol::Bye ClusterDesk::begin_leaving(const protocol::Bye& otherwise) {
  cluster_->begin_leaving();
  const auto successor = cluster_->successor();
  return successor ? moved(*successor) : otherwise;
}

void ClusterDesk::take_over(std::vector<RoomToGoOn> rooms) {
  owns_ = true;
  const auto opened = [&]() -> core::Expected<void> {
    for (RoomToGoOn& room : rooms) {
      const std::string name = room.name;
      if (auto one = rooms_.open(name, start_of(std::move(room))); !one) return one;
    }
    return rooms_.open_missing();
  }();
  if (!opened) rooms_.fail(opened.error().text());
}

void ClusterDesk::step_down(const std::string& address) {
  owns_ = false;
  for (const auto& room : lobby_.rooms()) {
    const std::string name = room->name();
    rooms_.closed(name);
    static_cast<void>(lobby_.close(name, moved(address), "the room goes on elsewhere", [] {}));
  }
}

Start ClusterDesk::start_of(RoomToGoOn room) const {
  assert(room.state.roster.empty());
  Start start;
  start.map = std::move(room.map);
  start.parent = replay::Parent{room.from, room.state.tick, room.state.hash};
  // Inputs are counted on, as the log counts them: who proves it knows of no other host.
  start.match = match::Match::restore(start.map, room.settings, room.state);
  start.map_file = start.map->definition.name;
  start.unclaimed = unclaimed_seats(*start.match);
  const std::uint64_t until =
      start.match->tick() + std::uint64_t{limits_.now()->resume_s} * start.match->settings().tick_hz;
  for (Seat& seat : start.unclaimed) {
    const auto claim = std::find_if(room.claims.begin(), room.claims.end(),
                                    [&seat](const Claim& one) { return one.louse == seat.louse; });
    if (claim == room.claims.end()) continue;
    seat.claim = claim->token;
    seat.occupant = Vacant{until};
  }
  return start;
}

}  // namespace woodlouse::server
