#include "client/net/connection.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace woodlouse::client {

using std::chrono::steady_clock;

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
  started_ = steady_clock::now();
  link_ = std::make_shared<Link>(context_, join_, *this);
  link_->open(address_, was_joined_ ? kPatience : kFirstPatience);
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

void Connection::watch_by_frames() {
  join_.stream = protocol::Stream::kFrames;
  join_.state_hz.reset();  // it was the stream's
  stop();
  start();
}

std::optional<double> Connection::seconds_left(core::Time now) const {
  if (!until_ || phase_ == Phase::kStopped) return std::nullopt;
  return std::max(0.0, std::chrono::duration<double>(*until_ - now).count());
}

void Connection::on_message(const protocol::ServerMessage& message, core::Time arrival) {
  if (const auto* welcome = std::get_if<protocol::Welcome>(&message)) {
    phase_ = Phase::kJoined;
    was_joined_ = true;
    until_.reset();
    join_.resume = welcome->resume_token;
  }
  listener_.on_message(message, arrival);
}

void Connection::on_closed(const Closing& closing) {
  const core::Time now = steady_clock::now();
  closing_ = closing;
  losses_ += phase_ == Phase::kJoined ? 1 : 0;
  link_.reset();
  if (!until_) until_ = now + kComesBackFor;
  const core::Time next =
      std::max(started_ + kAttemptEvery, now + closing.retry_after.value_or(std::chrono::milliseconds(0)));
  // Who was never welcomed has nothing to come back to, but to a server that names the time.
  const bool goes_on = is_passing(closing) && (was_joined_ || closing.retry_after) && next <= *until_;
  goes_on ? try_again(next) : stop();
  listener_.on_lost();
}

void Connection::try_again(core::Time at) {
  phase_ = Phase::kWaiting;
  retry_.expires_at(std::max(at, steady_clock::now()));
  retry_.async_wait([this](boost::system::error_code error) {
    if (!error && phase_ == Phase::kWaiting) start();
  });
}

}  // namespace woodlouse::client
