#include "bench/swarm/bot.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "bench/swarm/frame_scan.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::swarm {

using boost::system::error_code;

Bot::Bot(boost::asio::io_context& context, const Options& options, std::size_t number)
    : options_(options),
      number_(number),
      random_(options.seed * 0x9E3779B97F4A7C15u + number),
      socket_(context),
      steering_(context) {}

void Bot::start(const Tcp::resolver::results_type& endpoints) {
  state_ = State::kJoining;
  boost::asio::async_connect(socket_, endpoints, [this](error_code error, const Tcp::endpoint&) {
    if (error) return lose("connect: " + error.message());
    error_code ignored_where_unsupported;  // without it inputs are only later
    socket_.set_option(Tcp::no_delay(true), ignored_where_unsupported);
    read();
  });
}

void Bot::begin_measuring() {
  measuring_ = true;
  tally_ = {};
  last_frame_.reset();
}

void Bot::leave() {
  if (state_ != State::kJoined) return close();
  state_ = State::kLeaving;
  steering_.cancel();
  send(protocol::Leave{});
}

void Bot::close() {
  state_ = State::kClosed;
  steering_.cancel();
  error_code nothing_to_do_about_it;
  socket_.close(nothing_to_do_about_it);
}

void Bot::lose(std::string reason) {
  if (state_ == State::kClosed) return;
  if (state_ != State::kLeaving) loss_ = std::move(reason);
  close();
}

void Bot::read() {
  socket_.async_read_some(boost::asio::buffer(incoming_), [this](error_code error, std::size_t size) {
    if (state_ == State::kClosed) return;
    if (error) return lose("read: " + error.message());
    if (measuring_) tally_.bytes += size;
    framer_.append({incoming_.data(), size});
    take_lines(Clock::now());
    if (state_ != State::kClosed) read();
  });
}

void Bot::take_lines(Clock::time_point now) {
  while (state_ != State::kClosed) {
    const auto line = framer_.next();
    if (!line) return;
    if (line->oversize)
      return lose("a line of more than " + std::to_string(protocol::kMaxServerLineBytes) + " bytes");
    if (const auto tick = scan_frame_tick(line->text)) {
      take_frame(*tick, now);
      continue;
    }
    static const std::vector<protocol::Column> kNone;
    const auto message =
        protocol::decode_server(line->text, welcome_ ? welcome_->fields : kNone, options_.format);
    if (message) {
      take(*message, now);
    } else if (message.error().code != protocol::code::kUnknownType) {
      return lose("a line out of shape: " + message.error().text);
    }
  }
}

void Bot::take_frame(std::uint64_t tick, Clock::time_point now) {
  if (last_tick_ && tick <= *last_tick_) return;
  last_tick_ = tick;
  if (!measuring_) return;
  ++tally_.distinct_ticks;
  if (last_frame_) tally_.frame_gaps.add(now - *last_frame_);
  last_frame_ = now;
}

void Bot::take(const protocol::ServerMessage& message, Clock::time_point now) {
  using namespace protocol;
  if (std::holds_alternative<Hello>(message)) {
    Join join;
    join.role = Role::kBot;
    join.name = "swarm-" + std::to_string(number_ + 1);
    join.room = options_.room;
    join.format = options_.format;
    send(join);
  } else if (const auto* welcome = std::get_if<Welcome>(&message)) {
    welcome_ = *welcome;
    state_ = State::kJoined;
    if (options_.inputs_per_second > 0.0) steer_later();
  } else if (const auto* frame = std::get_if<Frame>(&message)) {
    take_frame(frame->tick, now);
  } else if (const auto* ack = std::get_if<Ack>(&message)) {
    take_ack(*ack, now);
  } else if (const auto* ping = std::get_if<Ping>(&message)) {
    send(Pong{ping->t});
  } else if (const auto* notice = std::get_if<Notice>(&message)) {
    ++complaints_["notice " + notice->code];
  } else if (const auto* error = std::get_if<ErrorMessage>(&message)) {
    ++complaints_["error " + error->code];
    if (error->fatal || state_ == State::kJoining) lose(error->code + ": " + error->text);
  } else if (const auto* bye = std::get_if<Bye>(&message)) {
    lose("bye " + bye->code + ": " + bye->text);
  }
}

void Bot::take_ack(const protocol::Ack& ack, Clock::time_point now) {
  while (!awaited_.empty() && awaited_.front().seq <= ack.seq) {
    const Sent sent = awaited_.front();
    awaited_.pop_front();
    if (sent.seq != ack.seq || !measuring_) continue;
    ++tally_.acks;
    tally_.input_to_ack.add(now - sent.time);
  }
}

void Bot::steer_later() {
  // Between half and one and a half of the interval, so that the bots don't fall into step.
  const std::chrono::duration<double> wait((0.5 + random_.uniform()) / options_.inputs_per_second);
  steering_.expires_after(std::chrono::duration_cast<Clock::duration>(wait));
  steering_.async_wait([this](error_code error) {
    if (!error && state_ == State::kJoined) steer();
  });
}

void Bot::steer() {
  if (awaited_.size() >= kMaxAwaited) awaited_.pop_front();
  if (measuring_) ++tally_.inputs;
  const protocol::Input input = random_input();
  awaited_.push_back({input.seq, Clock::now()});
  send(input);
  if (state_ == State::kJoined) steer_later();
}

protocol::Input Bot::random_input() {
  protocol::Input input;
  input.seq = ++seq_;
  const bool is_vector = random_.uniform() < 0.7;
  const double angle = 2.0 * std::numbers::pi * random_.uniform();
  const double strength = random_.uniform();
  input.thrust = is_vector ? state::Thrust{state::ThrustKind::kMapVector,
                                           {strength * std::cos(angle), strength * std::sin(angle)}}
                           : state::Thrust{state::ThrustKind::kAlongHeading, {2.0 * strength - 1.0, 0.0}};
  if (random_.uniform() < 0.5) input.ticks = 1 + static_cast<std::uint32_t>(random_.next() % 60);
  return input;
}

void Bot::send(const protocol::ClientMessage& message) {
  unsent_ += protocol::encode(message);
  if (unsent_.size() > kMaxUnsentBytes) return lose("the server takes nothing any more");
  if (sending_.empty()) flush();
}

void Bot::flush() {
  std::swap(sending_, unsent_);
  boost::asio::async_write(socket_, boost::asio::buffer(sending_), [this](error_code error, std::size_t) {
    sending_.clear();
    if (state_ == State::kClosed) return;
    // A failing write: the read that is under way brings the reason, the server's bye before it.
    if (!error && !unsent_.empty()) flush();
  });
}

}  // namespace woodlouse::swarm
