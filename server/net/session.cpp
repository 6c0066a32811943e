#include "server/net/session.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/dispatch.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <utility>
#include <variant>

#include "shared/core/stable_hash.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace code = protocol::code;
using boost::system::error_code;

double cost_of(const protocol::ClientMessage& message) {
  const bool is_costly =
      std::holds_alternative<protocol::Chat>(message) || std::holds_alternative<protocol::Respawn>(message) ||
      std::holds_alternative<protocol::GetMap>(message) || std::holds_alternative<protocol::Resync>(message);
  return is_costly ? Session::kBroadcastCost : 1.0;
}

}  // namespace

Session::Session(SessionId id, std::unique_ptr<Wire> wire, const SessionEnvironment& environment)
    : id_(id),
      wire_(std::move(wire)),
      environment_(environment),
      framer_(environment.limits.line),
      limiter_(environment.limits.messages_per_s, environment.limits.burst, environment.timekeeper.now()),
      outbox_(environment.limits.outbox_bytes),
      rate_(environment.timekeeper.now()),
      watch_(environment.timekeeper.make_alarm(wire_->executor())),
      handshake_until_(environment.timekeeper.now() + std::chrono::seconds(environment.limits.handshake_s)),
      active_(environment.timekeeper.now()) {}

void Session::start(std::function<void()> closed) {
  asio::dispatch(wire_->executor(), [self = shared_from_this(), closed = std::move(closed)]() mutable {
    self->closed_ = std::move(closed);
    protocol::Hello hello;
    hello.behavior = match::kBehavior;
    hello.server = self->environment_.server_name;
    hello.session = core::to_hex(self->id_);
    hello.rooms = self->environment_.directory.names();
    hello.features = {"quantized", "exact", "fields", "delta", "get_map"};
    hello.limits = self->environment_.limits;
    self->say(hello);
    self->on_watch();
    self->read();
  });
}

void Session::start_refused(protocol::ErrorMessage why, std::function<void()> closed) {
  asio::dispatch(wire_->executor(),
                 [self = shared_from_this(), why = std::move(why), closed = std::move(closed)]() mutable {
                   self->closed_ = std::move(closed);
                   self->read();
                   self->fail(why);
                 });
}

// ---- reading -------------------------------------------------------------------------------------------

void Session::read() {
  wire_->read_some(incoming_, [self = shared_from_this()](const error_code& error, std::size_t size) {
    self->on_read(error, size);
  });
}

void Session::on_read(const error_code& error, std::size_t size) {
  if (state_ == State::kClosed) return;
  if (error == asio::error::eof) return on_input_ended();
  if (error) return close();  // the client has gone, in whatever way
  if (is_listening()) {
    const Time read_at = now();
    framer_.append({incoming_.data(), size});
    while (is_listening()) {
      const auto line = framer_.next();
      if (!line) break;
      on_line(*line, read_at);
    }
  }
  if (state_ != State::kClosed) read();
}

void Session::on_input_ended() {
  input_ended_ = true;
  if (state_ == State::kDraining) return close();
  if (is_listening()) on_message(protocol::Leave{}, now());
}

/// What comes after a `leave` or while a bye is said is thrown away.
bool Session::is_listening() const {
  return state_ == State::kOpen && handshake_.state() != Handshake::State::kLeaving;
}

bool Session::admit_line(Time now, double cost) {
  switch (limiter_.take(now, cost)) {
    case RateLimiter::Verdict::kPass:
      return true;
    case RateLimiter::Verdict::kRefuse:
      say(protocol::ErrorMessage{std::string(code::kRateLimited),
                                 "more than " + std::to_string(environment_.limits.messages_per_s) +
                                     " messages a second: this one was dropped",
                                 false, limiter_.retry_after_ms(cost)});
      return false;
    case RateLimiter::Verdict::kFlood:
      fail(code::kFlood, "messages kept coming long after rate_limited");
      return false;
  }
  return false;
}

void Session::on_line(const protocol::LineFramer::Line& line, Time now) {
  active_ = now;
  environment_.traffic.lines_received.fetch_add(1, std::memory_order_relaxed);
  if (!admit_line(now, 1.0)) return;
  if (line.oversize)
    return fail(code::kLineTooLong,
                "a line is longer than " + std::to_string(environment_.limits.line) + " bytes");
  auto decoded = protocol::decode_client(line.text);
  if (decoded) return on_message(std::move(*decoded), now);
  const protocol::ErrorMessage error = handshake_.judge(decoded.error());
  if (error.fatal) return fail(error);
  say(error);
}

void Session::on_message(protocol::ClientMessage message, Time now) {
  if (const double cost = cost_of(message); cost > 1.0 && !admit_line(now, cost - 1.0)) return;
  if (const auto refusal = handshake_.judge(message)) return say(*refusal);
  if (const auto* ping = std::get_if<protocol::Ping>(&message)) return say(protocol::Pong{ping->t});
  if (std::holds_alternative<protocol::Pong>(message)) return;
  if (std::holds_alternative<protocol::List>(message)) return say(environment_.directory.list());
  if (std::holds_alternative<protocol::Leave>(message) && !door_) return say_goodbye();
  if (auto* join = std::get_if<protocol::Join>(&message)) {
    door_ = environment_.directory.find(join->room);
    if (door_) return door_->join(id_, shared_from_this(), std::move(*join));
    handshake_.refused();
    std::string names;
    for (const std::string& name : environment_.directory.names()) names += ' ' + name;
    return say(protocol::ErrorMessage{std::string(code::kUnknownRoom),
                                      "join.room: no room \"" + join->room + "\"; there are:" + names,
                                      false,
                                      {}});
  }
  door_->submit(id_, std::move(message), now);
}

// ---- writing -------------------------------------------------------------------------------------------

void Session::say(const protocol::ServerMessage& message) {
  push(answers_.line([&](std::string& text) { protocol::append(text, message); }));
}

void Session::push(Line line) {
  if (state_ != State::kOpen) return;
  if (outbox_.push(std::move(line)) == Outbox::Push::kOverflow)
    return fail(code::kSlow, "more than " + std::to_string(environment_.limits.outbox_bytes) +
                                 " bytes of events and answers wait for you");
  write();
}

void Session::write() {
  if (!writing_.empty() || state_ == State::kDraining || state_ == State::kClosed) return;
  writing_ = outbox_.take(std::move(writing_));
  if (writing_.empty()) {
    if (state_ != State::kSayingBye) return;
    state_ = State::kDraining;
    if (wire_->shut_down_sending() || input_ended_) return close();  // the client went first
    linger_until_ = std::min(linger_until_, now() + kLinger);
    return watch(linger_until_);
  }
  wire_->write(writing_.lines, [self = shared_from_this()](const error_code& error, std::size_t size) {
    self->on_written(error, size);
  });
}

void Session::on_written(const error_code& error, std::size_t size) {
  const std::size_t frames = writing_.frames;
  writing_.lines.clear();
  outbox_.written();
  if (state_ == State::kClosed) return;
  if (error) return close();
  active_ = now();
  environment_.traffic.frames_sent.fetch_add(frames, std::memory_order_relaxed);
  environment_.traffic.bytes_sent.fetch_add(size, std::memory_order_relaxed);
  write();
}

// ---- what the room says: each call hops to the session's executor ---------------------------------------

void Session::deliver(Line line) {
  asio::post(wire_->executor(),
             [self = shared_from_this(), line = std::move(line)]() mutable { self->push(std::move(line)); });
}

void Session::answer(protocol::ServerMessage message) {
  asio::post(wire_->executor(),
             [self = shared_from_this(), message = std::move(message)] { self->say(message); });
}

void Session::show_again(const Frame& frame) {
  asio::post(wire_->executor(), [self = shared_from_this(), frame] {
    if (self->state_ != State::kOpen) return;
    self->outbox_.offer(frame);
    self->write();
  });
}

void Session::show(const Frame& frame) {
  asio::post(wire_->executor(), [self = shared_from_this(), frame] {
    if (self->state_ != State::kOpen || !self->rate_.wants(frame, self->divisor_)) return;
    const FrameSlots::Outcome outcome = self->outbox_.offer(frame);
    if (outcome == FrameSlots::Outcome::kStale) return;
    self->tell_pace(self->rate_.on_frame(self->now(), outcome == FrameSlots::Outcome::kReplaced));
    self->write();
  });
}

void Session::tell_pace(SendRate::Change change) {
  if (change == SendRate::Change::kGiveUp) {
    environment_.log->info(fmt::format("session {:016x}: too slow even for keys", id_));
    return fail(code::kSlow, "you read too slowly, even for keys alone");
  }
  if (const auto notice = rate_.notice(change)) say(*notice);
}

void Session::deliver_map(Line line) {
  asio::post(wire_->executor(), [self = shared_from_this(), line = std::move(line)]() mutable {
    if (self->state_ != State::kOpen) return;
    if (self->outbox_.push_map(std::move(line)) == Outbox::PushMap::kAlreadyWaiting)
      return self->say(protocol::ErrorMessage{std::string(code::kRateLimited),
                                              "get_map: the map you asked for is still on its way", false,
                                              1000});
    self->write();
  });
}

void Session::welcome(protocol::Welcome welcome, std::uint32_t divisor) {
  asio::post(wire_->executor(), [self = shared_from_this(), welcome = std::move(welcome), divisor] {
    self->divisor_ = divisor;
    self->say(welcome);
  });
}

void Session::refuse_join(protocol::ErrorMessage error) {
  asio::post(wire_->executor(), [self = shared_from_this(), error = std::move(error)] {
    self->door_ = nullptr;
    const bool leaves = self->handshake_.state() == Handshake::State::kLeaving;
    self->handshake_.refused();
    self->say(error);
    if (leaves) self->say_goodbye();
  });
}

void Session::let_go() {
  asio::post(wire_->executor(), [self = shared_from_this()] { self->say_goodbye(); });
}

void Session::end(protocol::Bye bye) {
  asio::post(wire_->executor(), [self = shared_from_this(), bye = std::move(bye)] {
    self->say_bye({}, bye, Outbox::Replaceable::kDropped, kShutdownLinger);
  });
}

// ---- the end -------------------------------------------------------------------------------------------

void Session::fail(std::string_view code, std::string text) {
  fail(protocol::ErrorMessage{std::string(code), std::move(text), true, {}});
}

void Session::fail(const protocol::ErrorMessage& error) {
  environment_.log->info(fmt::format("session {:016x}: ended: {}: {}", id_, error.code, error.text));
  protocol::ErrorMessage fatal = error;
  fatal.fatal = true;
  say_bye(fatal, {error.code, error.text, false}, Outbox::Replaceable::kDropped, kLinger);
}

/// Whoever leaves gets all that it asked for before, map and keys too, in as long as any write may take.
void Session::say_goodbye() {
  say_bye({}, {std::string(code::kLeft), "goodbye", false}, Outbox::Replaceable::kSent,
          std::chrono::seconds(environment_.limits.idle_s));
}

void Session::say_bye(const std::optional<protocol::ErrorMessage>& error, const protocol::Bye& bye,
                      Outbox::Replaceable replaceable, Duration linger) {
  if (state_ == State::kClosed) return;
  linger_until_ = state_ == State::kOpen ? now() + linger : std::min(linger_until_, now() + linger);
  watch(linger_until_);
  if (state_ != State::kOpen) return;
  leave_room();
  std::string text = error ? protocol::encode(*error) : std::string{};
  text += protocol::encode(bye);
  outbox_.push_last(Line(std::move(text)), replaceable);
  state_ = State::kSayingBye;
  write();
}

void Session::leave_room() {
  if (door_) std::exchange(door_, nullptr)->leave(id_);
}

void Session::close() {
  if (state_ == State::kClosed) return;
  leave_room();
  state_ = State::kClosed;
  watch_->cancel();
  if (const error_code error = wire_->close())
    environment_.log->warn(fmt::format("session {:016x}: close: {}", id_, error.message()));
  std::exchange(closed_, nullptr)();
}

// ---- timeouts ------------------------------------------------------------------------------------------

void Session::watch(Time until) {
  watch_->set(until, [self = shared_from_this()](bool cancelled) {
    if (!cancelled) self->on_watch();
  });
}

void Session::on_watch() {
  if (state_ == State::kClosed) return;
  if (state_ != State::kOpen) {
    if (now() >= linger_until_) return close();
    return watch(linger_until_);
  }
  const bool has_joined = handshake_.state() != Handshake::State::kGreeting;
  const Time idle_until = active_ + std::chrono::seconds(environment_.limits.idle_s);
  const Time until = has_joined ? idle_until : std::min(idle_until, handshake_until_);
  if (now() < until) return watch(until);
  if (!has_joined && until == handshake_until_)
    return fail(code::kHandshakeTimeout,
                "no join within " + std::to_string(environment_.limits.handshake_s) + " s");
  fail(code::kIdle,
       "nothing read and nothing written for " + std::to_string(environment_.limits.idle_s) + " s");
}

}  // namespace woodlouse::server
