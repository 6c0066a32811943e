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

}  // namespace

Session::Session(SessionId id, std::unique_ptr<Wire> wire, const Lanes& lanes, std::size_t lane,
                 std::shared_ptr<AddressAccount> address, const SessionEnvironment& environment)
    : id_(id),
      wire_(std::move(wire)),
      lane_(lanes[lane]),
      lane_number_(lane),
      environment_(environment),
      limits_(environment.limits.now()),
      framer_(limits_->line),
      standing_(environment.doorman),
      allowance_(*limits_, std::move(address), now()),
      sender_(*this, *wire_, lane_, limits_->outbox_bytes, environment.traffic),
      rate_(now()),
      watch_(environment.timekeeper.make_alarm(lane_)),
      pulse_(*limits_, now()),
      handshake_until_(now() + std::chrono::seconds(limits_->handshake_s)) {
  assert(wire_ != nullptr);
}

void Session::start(std::function<void()> closed, Greeting greeting) {
  asio::dispatch(lane_, [self = shared_from_this(), closed = std::move(closed), greeting]() mutable {
    self->closed_ = std::move(closed);
    self->is_web_ = greeting != Greeting::kAtOnce;
    if (greeting != Greeting::kAfterFirstLine) self->greet();
    self->on_watch();
    self->read();
  });
}

void Session::start_refused(protocol::ErrorMessage why, std::function<void()> closed) {
  asio::dispatch(lane_,
                 [self = shared_from_this(), why = std::move(why), closed = std::move(closed)]() mutable {
                   self->closed_ = std::move(closed);
                   self->read();
                   self->fail(why);
                 });
}

// ---- reading -------------------------------------------------------------------------------------------

void Session::on_read(const error_code& error, std::size_t size) {
  if (state_ == State::kClosed) return;
  if (error == asio::error::eof) return on_input_ended();
  if (error) return close();  // the client has gone, in whatever way
  if (is_listening()) framer_.append({incoming_.data(), size});
  take_lines(now());
}

/// Those that have come, then reads on.
void Session::take_lines(Time now) {
  while (is_listening()) {
    if (const Duration wait = allowance_.wait_for_line(now); wait > Duration{}) {
      goes_on_at_ = now + wait;
      return watch_next(now);
    }
    const auto line = framer_.next();
    if (!line) break;
    on_line(*line, now);
  }
  if (state_ != State::kClosed) read();
}

void Session::on_line(const protocol::LineFramer::Line& line, Time now) {
  greet();
  pulse_.hear(now, false);
  environment_.traffic.lines_received.fetch_add(1, std::memory_order_relaxed);
  if (const auto refusal = allowance_.take_line(line.text.size() + 1, now)) return refuse(*refusal);
  if (line.oversize)
    return refuse({std::string(code::kLineTooLong),
                   "a line is longer than " + std::to_string(limits_->line) + " bytes", true, std::nullopt});
  auto decoded = protocol::decode_client(line.text);
  if (decoded) return on_message(std::move(*decoded), now);
  protocol::ErrorMessage error = handshake_.judge(decoded.error());
  error.text += where_http_is(line.text, environment_.web_url);
  refuse(error);
}

void Session::on_message(protocol::ClientMessage message, Time now) {
  if (const auto refusal = handshake_.why_not(message)) return say(*refusal);
  if (const auto spending = spending_of(message))
    if (const auto refusal = allowance_.spend(*spending, now)) return say(*refusal);
  if (const auto refusal = standing_.why_not(message, address(), now)) return refuse(*refusal);
  handshake_.take(message);
  if (const auto* ping = std::get_if<protocol::Ping>(&message)) return say(protocol::Pong{ping->t});
  if (std::holds_alternative<protocol::Pong>(message)) return pulse_.hear(now, true);
  if (const auto* list = std::get_if<protocol::List>(&message)) {
    if (rooms_.is_on() && !list->watch) handshake_until_ = now + std::chrono::seconds(limits_->handshake_s);
    rooms_.set(list->watch, environment_.directory, now);
    return tell_rooms(now);
  }
  if (auto* wanted = std::get_if<protocol::Join>(&message)) return join(standing_.take_token(*wanted), now);
  if (auto* wish = std::get_if<protocol::Moderate>(&message)) return moderate(std::move(*wish));
  if (const auto* look = std::get_if<protocol::Look>(&message); look && !is_for_room(*look)) return;
  if (waits_for_its_turn(message)) return ask(std::move(message), now);
  if (std::holds_alternative<protocol::Leave>(message)) {
    if (!input_ended_) parting_ = Parting::kLeft;
    if (!door_) return say_goodbye();
    for (const auto& refusal : allowance_.refuse_waiting()) say(refusal);
  }
  door_->submit(id_, std::move(message), now);
}

void Session::join(protocol::Join join, Time now) {
  door_ = environment_.directory.find_for(join.role, join.room);
  view_ = join.view.value_or(protocol::View{});
  if (door_)
    return door_->join({id_, shared_from_this(), std::move(join), allowance_.address().id(), now, is_web_,
                        standing_.why_no_newcomer()});
  handshake_.refused();
  if (const auto address = environment_.elsewhere ? environment_.elsewhere(join.room) : std::nullopt)
    return refuse(room_moved(join.room, *address));
  say(unknown_room(join.room, environment_.directory.names()));
}

/// Goes out with what else comes by then.
void Session::push(Line line) {
  queue(std::move(line));
  if (state_ == State::kOpen) sender_.write_soon();
}

void Session::queue(Line line) {
  if (state_ != State::kOpen) return;
  if (sender_.outbox().push(std::move(line)) == Outbox::Push::kOverflow)
    fail(code::kSlow,
         "more than " + std::to_string(limits_->outbox_bytes) + " bytes of events and answers wait for you");
}

void Session::on_all_sent() {
  if (state_ != State::kSayingBye) return ask_for_keyframe();
  state_ = State::kDraining;
  sender_.stop();
  if (wire_->shut_down_sending() || input_ended_) return close();  // the client went first
  linger_until_ = std::min(linger_until_, now() + kLinger);
  watch(linger_until_);
}

// ---- what the room says: each call hops to the session's lane -------------------------------------------

/// Within the call, where that is made there: as of show(), what a broadcaster hands out costs no hop.
void Session::deliver(Line line) {
  if (lane_.running_in_this_thread()) return push(std::move(line));
  asio::post(lane_,
             [self = shared_from_this(), line = std::move(line)]() mutable { self->push(std::move(line)); });
}

void Session::show_again(const Frame& frame) {
  asio::post(lane_, [self = shared_from_this(), frame] {
    const auto seen = self->state_ == State::kOpen ? self->seen(frame) : std::nullopt;
    if (!seen) return;
    if (frame.sheet && seen->kind == FrameKind::kKey) self->sender_.outbox().forget_frames();
    if (seen->kind == FrameKind::kKey) self->sizes_.key = seen->text->size();
    self->sender_.outbox().offer(*seen);
    self->sender_.write_soon();
  });
}

void Session::show(const Frame& frame) {
  if (lane_.running_in_this_thread()) return show_here(frame);
  asio::post(lane_, [self = shared_from_this(), frame] { self->show_here(frame); });
}

void Session::show_here(const Frame& frame) {
  if (state_ != State::kOpen || !rate_.wants(frame, divisor_)) return;
  const auto shown = seen(frame);
  if (!shown) return;
  const FrameSlots::Outcome outcome = sender_.outbox().offer(*shown);
  if (outcome == FrameSlots::Outcome::kStale) return;
  tell_pace(rate_.on_frame(now(), outcome == FrameSlots::Outcome::kReplaced));
  sender_.write();
}

void Session::tell_pace(SendRate::Change change) {
  if (change == SendRate::Change::kGiveUp) {
    return fail(code::kSlow, "you read too slowly, even for keys alone");
  }
  if (const auto notice = rate_.notice(change)) say(*notice);
}

void Session::deliver_map(Line line) {
  asio::post(lane_, [self = shared_from_this(), line = std::move(line)]() mutable {
    if (self->state_ != State::kOpen) return;
    if (self->sender_.outbox().push_map(std::move(line)) == Outbox::PushMap::kAlreadyWaiting)
      return self->say(protocol::ErrorMessage{std::string(code::kRateLimited),
                                              "get_map: the map you asked for is still on its way", false,
                                              1000});
    self->sender_.write_soon();
  });
}

void Session::welcome(protocol::Welcome welcome, std::uint32_t divisor) {
  asio::post(lane_, [self = shared_from_this(), welcome = std::move(welcome), divisor] {
    if (self->state_ != State::kOpen) return;
    self->divisor_ = divisor;
    self->sizes_.map = welcome.map_bytes;
    self->begin_viewing(welcome);
    self->sender_.outbox().begin_anew();
    self->say(welcome);
    self->watch_next(self->now());
    self->log(
        welcome.resumed ? LogEvent::kCameBack : LogEvent::kJoined,
        fmt::format("{} room {} as {} \"{}\"", welcome.resumed ? "came back to" : "joined", welcome.room,
                    welcome.id == 0 ? "a spectator" : fmt::format("louse {}", welcome.id), welcome.name));
  });
}

void Session::refuse_join(protocol::ErrorMessage error) {
  asio::post(lane_, [self = shared_from_this(), error = std::move(error)] {
    self->door_ = nullptr;
    const bool leaves = self->handshake_.state() == Handshake::State::kLeaving;
    self->handshake_.refused();
    self->say(error);
    for (const auto& refusal : self->allowance_.refuse_waiting()) self->say(refusal);
    if (leaves) self->say_goodbye();
  });
}

// ---- the end -------------------------------------------------------------------------------------------

void Session::fail(const protocol::ErrorMessage& error) {
  if (!std::exchange(is_end_told_, true))
    log(LogEvent::kSessionEnded, fmt::format("ended: {}: {}", error.code, error.text));
  if (error.code != code::kSlow) parting_ = Parting::kLeft;
  protocol::ErrorMessage fatal = error;
  fatal.fatal = true;
  const bool is_elsewhere = error.code == code::kMoved;  // and whoever goes there may go on
  say_bye(fatal, {error.code, error.text, is_elsewhere, error.address}, Outbox::Replaceable::kDropped,
          kLinger);
}

/// Whoever leaves gets all that it asked for before, map and keys too, in as long as any write may take.
void Session::say_goodbye() {
  say_bye({}, {std::string(code::kLeft), "goodbye", false}, Outbox::Replaceable::kSent,
          std::chrono::seconds(limits_->idle_s));
}

void Session::say_bye(const std::optional<protocol::ErrorMessage>& error, const protocol::Bye& bye,
                      Outbox::Replaceable replaceable, Duration linger) {
  if (state_ == State::kClosed) return;
  linger_until_ = state_ == State::kOpen ? now() + linger : std::min(linger_until_, now() + linger);
  watch(linger_until_);
  if (state_ != State::kOpen) return;
  environment_.traffic.session_ends.add(bye.code);
  leave_room();
  std::string text = error ? protocol::encode(*error) : std::string{};
  text += protocol::encode(bye);
  sender_.outbox().push_last(Line(std::move(text)), replaceable);
  state_ = State::kSayingBye;
  sender_.write();
  if (std::exchange(goes_on_at_, std::nullopt) && state_ != State::kClosed) read();
}

void Session::close() {
  if (state_ == State::kClosed) return;
  leave_room();
  if (state_ == State::kOpen) TrafficMetrics::add_one(environment_.traffic.sessions_lost);
  state_ = State::kClosed;
  sender_.stop();
  watch_->cancel();
  if (const error_code error = wire_->close()) log(LogEvent::kCloseFailed, "close: " + error.message());
  std::exchange(closed_, nullptr)();
}

// ---- timeouts ------------------------------------------------------------------------------------------

void Session::on_watch() {
  if (state_ == State::kClosed) return;
  if (state_ != State::kOpen) {
    if (now() >= linger_until_) return close();
    return watch(linger_until_);
  }
  const Time at = now();
  if (goes_on_at_ && at >= *goes_on_at_) {
    goes_on_at_.reset();
    take_lines(at);
  }
  if (rooms_.take_change(environment_.directory, at)) tell_rooms(at);
  if (!is_to_join())
    check_pulse(at);
  else if (at >= handshake_until_)
    fail(code::kHandshakeTimeout, "no join within " + std::to_string(limits_->handshake_s) + " s");
  if (state_ == State::kOpen) watch_next(at);
}

void Session::watch_next(Time now) {
  const Time until =
      is_to_join() ? handshake_until_ : std::min(pulse_.next(), allowance_.next(now).value_or(Time::max()));
  watch(std::min({until, goes_on_at_.value_or(Time::max()), rooms_.next()}));
}

void Session::check_pulse(Time now) {
  if (state_ != State::kOpen) return;
  pass_on_due(now);
  for (;;) switch (pulse_.due(now)) {
      case Pulse::Sign::kNone:
        return;
      case Pulse::Sign::kPing:
        queue(answers_.line([this](std::string& text) {
          protocol::append(text, protocol::Ping{++pings_, hosts_.since(environment_.hosts)});
        }));
        sender_.write();
        break;
      case Pulse::Sign::kVacant:
        if (door_) door_->vacate(id_);
        break;
      case Pulse::Sign::kIdle:
        return fail(
            code::kIdle,
            pulse_.answers()
                ? "nothing came from you for " + std::to_string(limits_->vacant_s + limits_->resume_s) + " s"
                : "nothing read and nothing written for " + std::to_string(limits_->idle_s) + " s");
    }
}

void Session::log(LogEvent event, const std::string& what) {
  if (!is_logged(*environment_.log, event)) return;
  const auto left_out = allowance_.address().take_log_line(now());
  if (!left_out) return;
  const std::string others =
      *left_out == 0 ? "" : fmt::format(" ({} lines of this address left out)", *left_out);
  log_event(*environment_.log, event,
            fmt::format("session {:016x} of {}: {}{}", id_, allowance_.address().name(), what, others));
}

}  // namespace woodlouse::server
