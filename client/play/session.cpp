#include "client/play/session.h"

#include <utility>

namespace woodlouse::client {

Session::Session(boost::asio::io_context& context, const Address& address, protocol::Join join)
    : context_(context), connection_(context, address, std::move(join), *this) {}

core::Expected<void> Session::join() {
  const core::Time begin = std::chrono::steady_clock::now();
  connection_.start();
  context_.restart();
  while (connection_.phase() == Connection::Phase::kConnecting) context_.run_one();
  join_time_ =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  if (connection_.phase() == Connection::Phase::kJoined) return {};
  connection_.stop();
  return core::fail(connection_.address().text(), connection_.reason());
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

void Session::on_lost() { room_.on_lost(); }

}  // namespace woodlouse::client
