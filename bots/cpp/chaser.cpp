// Runs after the nearest other louse: woodlouse-chaser [HOST:PORT]
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <variant>

#include "bots/cpp/line_client.h"

namespace {

using namespace woodlouse;
using bots::WorldView;

/// Places in a row: the columns asked for.
enum Place : std::size_t { kId, kX, kY, kVx, kVy };

/// Towards where the nearest other louse will stand to it in half a second, the harder the farther; nothing
/// when it is alone.
core::Vec2 chase(const std::vector<double>& me, const WorldView& view) {
  double nearest = std::numeric_limits<double>::infinity();
  core::Vec2 way;
  for (const auto& [id, row] : view.rows()) {
    const core::Vec2 apart{row[kX] - me[kX], row[kY] - me[kY]};
    const double distance = std::hypot(apart.x, apart.y);
    if (id == static_cast<std::uint32_t>(me[kId]) || distance >= nearest) continue;
    nearest = distance;
    way = {apart.x + 0.5 * (row[kVx] - me[kVx]), apart.y + 0.5 * (row[kVy] - me[kVy])};
  }
  return way;
}

core::Expected<void> play(bots::LineClient& client, std::uint32_t id) {
  WorldView view;
  protocol::Input input;
  input.thrust.kind = state::ThrustKind::kMapVector;
  for (;;) {
    const auto message = client.receive();
    if (!message) return tl::unexpected(message.error());
    core::Expected<void> sent;
    if (const auto* frame = std::get_if<protocol::Frame>(&*message)) {
      if (!view.take(*frame)) {
        sent = client.send(protocol::Resync{});
      } else if (const auto me = view.rows().find(id); me != view.rows().end()) {
        ++input.seq;
        input.thrust.value = chase(me->second, view);  // the server cuts it to length 1
        sent = client.send(input);
      }
    } else if (const auto* welcome = std::get_if<protocol::Welcome>(&*message)) {
      id = welcome->id;  // of the room's next game
      view = WorldView();
    } else if (const auto* ping = std::get_if<protocol::Ping>(&*message)) {
      sent = client.send(protocol::Pong{ping->t});
    } else if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message)) {
      std::cerr << error->code << ": " << error->text << "\n";
    } else if (const auto* bye = std::get_if<protocol::Bye>(&*message)) {
      std::cout << "bye: " << bye->text << "\n";
      return {};
    }
    if (!sent) return sent;
  }
}

int failed(const core::Error& error) {
  std::cerr << "woodlouse-chaser: " << error.text() << "\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string address = argc > 1 ? argv[1] : "127.0.0.1:7777";
  const auto server = protocol::parse_host_address(address);
  if (argc > 2 || !server) {
    std::cerr << "usage: woodlouse-chaser [HOST:PORT]\n";
    return 2;
  }
  protocol::Join join;
  join.role = protocol::Role::kBot;
  join.name = "Chaser";
  join.may_resume = true;
  join.fields = protocol::default_columns();
  bots::LineClient client;
  auto welcome = client.join(*server, join);
  while (welcome) {
    std::cout << (welcome->resumed ? "back in louse " : "louse ") << welcome->id << " in room "
              << welcome->room;
    if (client.address() != *server) std::cout << ", which is at " << client.address().text() << " now";
    std::cout << "\n" << std::flush;
    const auto played = play(client, welcome->id);
    if (played) return 0;
    if (!client.is_broken()) return failed(played.error());
    std::cerr << played.error().text() << "; coming back\n";
    welcome = client.come_back();
  }
  return failed(welcome.error());
}
