#include "client/play/session.h"

#include <utility>

#include "shared/protocol/codes.h"

namespace woodlouse::client {

Session::Session(boost::asio::io_context& context, const Address& address, protocol::Join join)
    : context_(context), connection_(context, address, std::move(join), *this) {}

core::Expected<void> Session::join() {
  const core::Time begin = std::chrono::steady_clock::now();
  connection_.start();
  context_.restart();
  while (is_trying()) context_.run_one();
  join_time_ =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  if (connection_.phase() == Connection::Phase::kJoined) return {};
  return core::fail(connection_.address().text(), connection_.closing().reason);
}

void Session::update(core::Time now) {
  room_.update(now);
  for (const protocol::ClientMessage& message : room_.take_outgoing()) connection_.send(message);
}

void Session::leave() {
  if (connection_.phase() == Connection::Phase::kJoined) {
    connection_.send(protocol::Leave{});
    context_.restart();
    const core::Time end = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    while (connection_.phase() == Connection::Phase::kJoined && std::chrono::steady_clock::now() < end) {
      context_.run_one_until(end);
    }
  }
  connection_.stop();
}

void Session::on_message(const protocol::ServerMessage& message, core::Time arrival) {
  const auto taken = room_.on_message(message, arrival);
  for (const protocol::ClientMessage& answer : room_.take_outgoing()) connection_.send(answer);
  if (taken) return;
  failure_ = taken.error();
  connection_.stop();
}

void Session::on_recorded(std::string_view line, core::Time arrival) {
  if (room_.follow(line, arrival)) return;
  // What is shown from here on is the server's word, but it is the room.
  connection_.watch_by_frames();
  room_.on_lost();
}

void Session::on_lost() {
  room_.on_lost();
  if (connection_.phase() == Connection::Phase::kStopped && connection_.was_joined()) failure_ = farewell();
}

core::Error Session::farewell() const {
  const Closing& closing = connection_.closing();
  const std::string again = "woodlouse " + connection_.address().text();
  core::Error error(connection_.address().text(), closing.reason);
  if (closing.code == protocol::code::kReplaced) {
    error.hint = "your louse is played from there now; who wants another one here:  " + again;
  } else if (closing.code == protocol::code::kShutdown) {
    error.hint = "when it is up again:  " + again;
  } else if (is_passing(closing)) {
    error.what = "the connection was lost and did not come back within " +
                 std::to_string(Connection::kComesBackFor.count()) + " s: " + closing.reason;
    error.hint = "when the server can be reached again:  " + again;
  } else {
    error.hint = "to join anew:  " + again;
  }
  return error;
}

}  // namespace woodlouse::client
