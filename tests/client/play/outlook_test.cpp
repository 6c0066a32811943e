#include "client/play/outlook.h"

#include <catch2/catch.hpp>

#include "client/play/room_view.h"

namespace woodlouse::client::outlook_test {
namespace {

constexpr std::array<double, 4> kExtent = {-30, -40, 30, 40};

protocol::Welcome welcome() {
  protocol::Welcome welcome;
  welcome.id = 7;
  welcome.name = "ann";
  welcome.fields = wanted_columns();
  welcome.extent = kExtent;
  welcome.view_rows = protocol::kEveryRow;
  return welcome;
}

std::vector<protocol::View> looks(RoomView& room) {
  std::vector<protocol::View> views;
  for (const protocol::ClientMessage& message : room.take_outgoing())
    if (const auto* look = std::get_if<protocol::Look>(&message)) views.push_back(look->view);
  return views;
}

}  // namespace

TEST_CASE("a camera that follows a louse in a crowd asks for what comes into its picture") {
  Interface interface;
  interface.view = View::kFollow;
  interface.zoom = 1.0;
  CHECK(outlook(interface, kExtent, kCrowd - 1).is_whole());
  const auto near = outlook(interface, kExtent, kCrowd);
  CHECK(near.radius == Approx(100.0 / 2.6));
  CHECK_FALSE((near.rows || near.place || near.louse));
  interface.zoom = 4.0;
  CHECK(outlook(interface, kExtent, kCrowd).radius == Approx(100.0 / 10.4));
  interface.overlay = Overlay::kScoreboard;
  CHECK(outlook(interface, kExtent, kCrowd).is_whole());
  interface.overlay = Overlay::kNone;
  for (const View view : {View::kMap, View::kOblique, View::kSlope}) {
    interface.view = view;
    CHECK(outlook(interface, kExtent, 1000).is_whole());
  }
}

TEST_CASE("a view is asked for once, anew on another connection, and not of who can't show one") {
  RoomView room;
  const core::Time now{};
  protocol::View part;
  part.radius = 9.0;
  room.look(part);
  CHECK(looks(room).empty());  // not joined yet
  REQUIRE(room.on_message(welcome(), now));
  room.look({});
  CHECK(looks(room).empty());
  room.look(part);
  room.look(part);
  CHECK(looks(room) == std::vector{part});
  CHECK(room.sees_part());
  room.on_lost();
  room.on_lost();  // an attempt that failed
  CHECK_FALSE(room.sees_part());
  CHECK(room.sight().is_part);  // the picture stays one of a part
  protocol::Welcome former = welcome();
  former.view_rows.reset();
  REQUIRE(room.on_message(former, now));
  room.look(part);
  CHECK(looks(room).empty());
  protocol::Welcome proof = welcome();
  proof.format = protocol::Format::kExact;
  room.on_lost();
  REQUIRE(room.on_message(proof, now));
  room.look(part);
  CHECK(looks(room).empty());
}

}  // namespace woodlouse::client::outlook_test
