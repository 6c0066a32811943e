#include "server/cluster_desk.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/access/bans.h"
#include "server/chosen_games.h"
#include "server/net/listen_address.h"
#include "server/net/session.h"
#include "server/version.h"
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

/// Where clients of others are sent; empty: it listens at every address, and was told none.
core::Expected<std::string> address_of(const ServeConfig& config, const std::string& lines,
                                       const std::string& web_url) {
  if (!config.cluster->address.empty()) return config.cluster->address;
  std::string address = lines;
  if (config.web && !config.web->tls) {
    const auto web =
        parse_listen_address(web_url.substr(0, web_url.rfind('/')).substr(web_url.rfind("//") + 2), "--web");
    if (!web) return tl::unexpected(web.error());
    address = to_text(ListenAddress{config.web->listen.host, web->port});
  }
  return address.starts_with("0.0.0.0:") || address.starts_with("[::]:") ? std::string() : address;
}

/// Of a moment by the calendar [Unix s]; long ago: as if it had never been, far off: for good.
Time time_of(std::uint64_t moment) {
  constexpr std::uint64_t kFarOff = 1'000'000'000;
  const auto now = static_cast<std::uint64_t>(wall_now().time_since_epoch().count());
  if (moment <= now) return Time{};
  return moment - now > kFarOff ? Time::max() : Clock::now() + std::chrono::seconds(moment - now);
}

}  // namespace

core::Expected<void> ClusterDesk::open(const ServeConfig& config, const std::string& lines,
                                       const std::string& web_url) {
  assert(!cluster_ && config.cluster);
  name_ = config.cluster->cluster;
  shard_ = config.cluster->shard;
  auto address = address_of(config, lines, web_url);
  if (!address) return tl::unexpected(address.error());
  ClusterSettings settings = *config.cluster;
  settings.address = std::move(*address);
  if (settings.is_edge) return open_edge(config, std::move(settings));
  const auto games = choose_games(config);
  if (!games) return tl::unexpected(games.error());
  if (games->size() > kMostRoomsOfShard)
    return core::fail("--map", joined({std::to_string(games->size()), " rooms are more than the ",
                                       std::to_string(kMostRoomsOfShard), " of a cluster"}));
  if (settings.address.empty())
    return core::fail("--cluster-address", "this host listens at every address: clients of others need one",
                      "as  --cluster-address 192.0.2.7:7777");
  for (const ChosenGame& game : *games) own_rooms_.insert(game.room);
  auto cluster = Cluster::open(std::move(settings), hooks(), log_);
  if (!cluster) return tl::unexpected(cluster.error());
  cluster_ = std::move(*cluster);
  return {};
}

/// Parts come each `batch`, on ways that differ by less than half of one.
core::Expected<void> ClusterDesk::open_edge(const ServeConfig& config, ClusterSettings settings) {
  RoomSettings rooms;
  rooms.build = kServerName;
  rooms.state_hz = config.state_hz;
  relay_.emplace(stage_.ticks, stage_.lanes, rooms, limits_, settings.batch * 3 / 2, stage_.timekeeper, log_);
  Cluster::Viewers viewers;
  viewers.lines = [this](const std::string& room, std::vector<std::string> lines) {
    relay_->take(room, std::move(lines));
  };
  viewers.closed = [this](const std::string& room) { relay_->close(room); };
  auto cluster = Cluster::open(std::move(settings), std::move(viewers), log_);
  if (!cluster) return tl::unexpected(cluster.error());
  cluster_ = std::move(*cluster);
  relay_->set_hears([this] { return cluster_->figures().connected; });
  return {};
}

Cluster::Hooks ClusterDesk::hooks() {
  Cluster::Hooks hooks;
  hooks.take_over = [this](std::vector<RoomToGoOn> rooms) {
    boost::asio::post(strand_, [this, rooms = std::move(rooms)]() mutable { take_over(std::move(rooms)); });
  };
  hooks.step_down = [this](const std::string& elsewhere) {
    boost::asio::post(strand_, [this, elsewhere] { step_down(elsewhere); });
  };
  hooks.stands_by = [this](const std::vector<std::string>& rooms) {
    boost::asio::post(strand_, [this, rooms] { stand_by(rooms); });
  };
  hooks.move = [this](const std::string& to) {
    boost::asio::post(strand_, [this, to] {
      if (!move(to)) log_event(*log_, LogEvent::kClusterFault, "cluster: asked to move its rooms, and can't");
    });
  };
  hooks.census = [this] { return lobby_.list().rooms; };
  return hooks;
}

void ClusterDesk::guide(RoomGuide& guide, SessionEnvironment& sessions) const {
  assert(cluster_ && !shard_.empty());
  if (relay_) guide.show(*relay_);
  guide.use({name_, shard_, [this] { return cluster_->rooms_elsewhere(); },
             [this](std::string_view room) { return elsewhere(room); }});
  sessions.elsewhere = [&guide](std::string_view room) { return guide.elsewhere(room); };
  sessions.hosts = [this] { return cluster_->hosts(); };
}

protocol::Bye ClusterDesk::begin_leaving(const protocol::Bye& otherwise) {
  cluster_->begin_leaving({});
  if (relay_) {
    if (cluster_->hosts().empty()) return otherwise;
    // No address: all would go to that one. Each tries those that he was told, and a browser its own again.
    return {std::string(protocol::code::kMoved), "this server stops: the room is shown elsewhere", true, {}};
  }
  // Who has taken them over by now is no successor any more.
  if (!went_to_.empty()) return moved(went_to_);
  if (const auto owner = cluster_->elsewhere({})) return moved(*owner);
  const auto successor = cluster_->successor();
  return successor ? moved(*successor) : otherwise;
}

bool ClusterDesk::move_away(std::function<void()> gone) {
  assert(gone && !gone_);
  if (relay_ || !move({})) return false;
  gone_ = std::move(gone);
  return true;
}

/// The rooms stand, nobody is told; all of it is stored; another host goes on with them; then who is here is
/// sent there, and finds them.
bool ClusterDesk::move(const std::string& to) {
  const auto rooms = lobby_.rooms();
  if (!owns_ || rooms_left_ != 0 || rooms.empty() || !cluster_->successor(to)) return false;
  cluster_->begin_leaving(to);
  rooms_left_ = rooms.size();
  owns_ = false;
  const auto one_stands = [this] {
    assert(rooms_left_ > 0);
    if (--rooms_left_ == 0) cluster_->hand_over();
  };
  for (const auto& room : rooms) room->hold([this, one_stands] { boost::asio::post(strand_, one_stands); });
  return true;
}

/// What the cluster plays goes before what this host was to play: who expects that is told.
void ClusterDesk::stand_by(const std::vector<std::string>& rooms) {
  std::string others;
  std::size_t count = 0;
  for (const std::string& own : own_rooms_)
    if (std::find(rooms.begin(), rooms.end(), own) == rooms.end() && ++count <= 5)
      others += others.empty() ? own : joined({", ", own});
  if (count > 5) others += joined({" and ", std::to_string(count - 5), " more"});
  if (others == others_told_) return;
  others_told_ = others;
  if (others.empty()) return;
  log_event(*log_, LogEvent::kClusterFollows,
            joined({"cluster: the cluster does not play ", others,
                    ", which this host would: opened once its rooms are here"}));
}

void ClusterDesk::take_over(std::vector<RoomToGoOn> rooms) {
  owns_ = true;
  went_to_.clear();
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
  went_to_ = address;
  for (const auto& room : lobby_.rooms()) {
    const std::string name = room->name();
    rooms_.closed(name);
    static_cast<void>(lobby_.close(name, moved(address), "the room goes on elsewhere", [] {}));
  }
  if (gone_) std::exchange(gone_, nullptr)();
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
    seat.mute_ends = claim->muted_until;
    seat.muted_until = time_of(claim->muted_until);
  }
  return start;
}

}  // namespace woodlouse::server
