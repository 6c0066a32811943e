#include "client/net/connection.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace woodlouse::client {

std::chrono::seconds retry_delay(int attempt) {
  constexpr int kDoublings = 4;
  return std::chrono::seconds(attempt > kDoublings ? 15 : 1 << (std::max(attempt, 1) - 1));
}

Connection::Connection(boost::asio::io_context& context, Address address, protocol::Join join,
                       ConnectionListener& listener)
    : context_(context),
      address_(std::move(address)),
      join_(std::move(join)),
      listener_(listener),
      retry_(context) {}

Connection::~Connection() { stop(); }

void Connection::start() {
  phase_ = Phase::kConnecting;
  link_ = std::make_shared<Link>(context_, join_, *this);
  link_->open(address_);
}

void Connection::send(const protocol::ClientMessage& message) {
  if (link_) link_->send(message);
}

void Connection::stop() {
  phase_ = Phase::kStopped;
  retry_.cancel();
  if (link_) link_->close();
  link_.reset();
}

double Connection::retry_seconds(core::Time now) const {
  if (phase_ != Phase::kWaiting) return 0.0;
  return std::max(0.0, std::chrono::duration<double>(retry_.expiry() - now).count());
}

void Connection::on_message(const protocol::ServerMessage& message, core::Time arrival) {
  was_answered_ = true;
  if (std::holds_alternative<protocol::Welcome>(message)) {
    phase_ = Phase::kJoined;
    was_joined_ = true;
    attempts_ = 0;
  }
  listener_.on_message(message, arrival);
}

void Connection::on_closed(const std::string& reason) {
  reason_ = reason;
  link_.reset();
  ++attempts_;
  phase_ = Phase::kWaiting;
  retry_.expires_after(retry_delay(attempts_));
  retry_.async_wait([this](boost::system::error_code error) {
    if (!error && phase_ == Phase::kWaiting) start();
  });
  listener_.on_lost();
}

}  // namespace woodlouse::client
