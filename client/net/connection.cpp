#include "client/net/connection.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <random>
#include <utility>
#include <variant>

#include "shared/protocol/codes.h"

namespace woodlouse::client {

using std::chrono::steady_clock;

namespace {

double seconds(core::Time::duration time) { return std::chrono::duration<double>(time).count(); }

/// What many clients of one server do at once they do at many times.
double chance() {
  std::random_device device;
  return std::generate_canonical<double, 32>(device);
}

bool is_this_machine(const std::string& host) {
  boost::system::error_code is_a_name;
  const auto address = boost::asio::ip::make_address(host, is_a_name);
  return is_a_name ? host == "localhost" : address.is_loopback();
}

}  // namespace

Connection::Connection(boost::asio::io_context& context, Address address, protocol::Join join,
                       ConnectionListener& listener)
    : context_(context),
      asked_(std::move(address)),
      address_(asked_),
      places_({asked_.host, asked_.port}),
      join_(std::move(join)),
      listener_(listener),
      retry_(context) {}

Connection::~Connection() { stop(); }

void Connection::start() {
  phase_ = Phase::kConnecting;
  address_ = {places_.place().host, places_.place().port};
  protocol::Join join = join_;
  if (!may_say_password()) join.token.clear();
  link_ = std::make_shared<Link>(context_, std::move(join), *this);
  link_->open(address_, was_joined_ ? kPatience : kFirstPatience);
}

/// It is meant for the server that was asked for; to another machine's it would go as plain text.
bool Connection::may_say_password() const { return address_ == asked_ || is_this_machine(address_.host); }

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
  if (const auto* hello = std::get_if<protocol::Hello>(&message)) hosts_ = hello->hosts;
  if (const auto* ping = std::get_if<protocol::Ping>(&message); ping && ping->hosts) {
    hosts_ = *ping->hosts;
    if (phase_ == Phase::kJoined) places_.welcomed(hosts_);
  }
  if (const auto* welcome = std::get_if<protocol::Welcome>(&message)) {
    if (phase_ != Phase::kJoined) joined_at_ = arrival;
    phase_ = Phase::kJoined;
    was_joined_ = true;
    until_.reset();
    join_.resume = welcome->resume_token;
    join_.room = welcome->room;  // the first one of another server may be another
    places_.welcomed(hosts_);
  }
  listener_.on_message(message, arrival);
}

void Connection::on_closed(const Closing& closing) {
  const core::Time now = steady_clock::now();
  const bool was_up = phase_ == Phase::kJoined;
  const auto up_for = was_up ? std::optional(seconds(now - joined_at_)) : std::nullopt;
  closing_ = closing;
  link_.reset();
  if (closing.code == protocol::code::kMoved && follows(up_for)) {
    phase_ = Phase::kConnecting;
    listener_.on_lost();
    return phase_ == Phase::kConnecting ? start() : void();
  }
  losses_ += was_up ? 1 : 0;
  if (!until_) until_ = now + kComesBackFor;
  const bool passes = is_passing(closing) || (!was_up && places_.has_others() && may_be_elsewhere(closing));
  const std::chrono::duration<double> wait(places_.lost(up_for, chance()));
  const core::Time next =
      now + std::max(std::chrono::duration_cast<core::Time::duration>(wait),
                     core::Time::duration(closing.retry_after.value_or(std::chrono::milliseconds(0))));
  // Who was never welcomed has nothing to come back to, but to a server that names the time.
  const bool goes_on = passes && (was_joined_ || closing.retry_after) && next <= *until_;
  goes_on ? try_again(next) : stop();
  listener_.on_lost();
}

bool Connection::follows(std::optional<double> up_for) {
  switch (places_.moved(closing_.address, up_for)) {
    case protocol::Whereabouts::Sent::kFollows:
      return true;
    case protocol::Whereabouts::Sent::kTooOften:
      closing_.reason = "sent on from server to server, to " + closing_.address + " last";
      return false;
    case protocol::Whereabouts::Sent::kNoAddress:
      break;
  }
  closing_.reason = closing_.address.empty()
                        ? "the room has moved, and the server does not say where"
                        : "the room has moved to \"" + closing_.address + "\", which is no HOST:PORT";
  return false;
}

void Connection::try_again(core::Time at) {
  phase_ = Phase::kWaiting;
  retry_.expires_at(std::max(at, steady_clock::now()));
  retry_.async_wait([this](boost::system::error_code error) {
    if (!error && phase_ == Phase::kWaiting) start();
  });
}

}  // namespace woodlouse::client
