// What a room says to a session: each call hops to the session's strand, then into the outbox.
#include <boost/asio/post.hpp>

#include <utility>

#include "server/net/session.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {

namespace asio = boost::asio;
namespace code = protocol::code;

void Session::deliver(Line line) {
  asio::post(socket_.get_executor(),
             [self = shared_from_this(), line = std::move(line)]() mutable { self->push(std::move(line)); });
}

void Session::answer(protocol::ServerMessage message) {
  asio::post(socket_.get_executor(),
             [self = shared_from_this(), message = std::move(message)] { self->say(message); });
}

void Session::show_again(const Frame& frame) {
  asio::post(socket_.get_executor(), [self = shared_from_this(), frame] {
    if (self->state_ != State::kOpen) return;
    self->outbox_.offer(frame);
    self->write();
  });
}

void Session::show(const Frame& frame) {
  asio::post(socket_.get_executor(), [self = shared_from_this(), frame] {
    if (self->state_ != State::kOpen || !self->pace_.wants(frame, self->divisor_)) return;
    const FrameSlots::Outcome outcome = self->outbox_.offer(frame);
    if (outcome == FrameSlots::Outcome::kStale) return;
    self->tell_pace(self->pace_.on_frame(Clock::now(), outcome == FrameSlots::Outcome::kReplaced));
    self->write();
  });
}

void Session::tell_pace(PaceKeeper::Change change) {
  if (change == PaceKeeper::Change::kNone) return;
  if (change == PaceKeeper::Change::kGiveUp) {
    environment_.log->info("session {:016x}: too slow even for keys", id_);
    return fail(code::kSlow, "you read too slowly, even for keys alone");
  }
  switch (pace_.pace()) {
    case Pace::kFull:
      return say(protocol::Notice{std::string(code::kRateRestored), "frames at the full rate again"});
    case Pace::kHalf:
      if (change == PaceKeeper::Change::kRestored)
        return say(protocol::Notice{std::string(code::kRateLowered), "deltas again, at half the rate"});
      return say(protocol::Notice{std::string(code::kRateLowered),
                                  "you read slower than frames come: half the rate from now on"});
    case Pace::kKeysOnly:
      return say(
          protocol::Notice{std::string(code::kKeysOnly), "you read very slowly: only keys from now on"});
  }
}

void Session::deliver_map(Line line) {
  asio::post(socket_.get_executor(), [self = shared_from_this(), line = std::move(line)]() mutable {
    if (self->state_ != State::kOpen) return;
    if (self->outbox_.push_map(std::move(line)) == Outbox::PushMap::kAlreadyWaiting)
      return self->say(protocol::ErrorMessage{std::string(code::kRateLimited),
                                              "get_map: the map you asked for is still on its way", false,
                                              1000});
    self->write();
  });
}

void Session::welcome(protocol::Welcome welcome, std::uint32_t divisor) {
  asio::post(socket_.get_executor(), [self = shared_from_this(), welcome = std::move(welcome), divisor] {
    self->divisor_ = divisor;
    self->say(welcome);
  });
}

void Session::refuse_join(protocol::ErrorMessage error) {
  asio::post(socket_.get_executor(), [self = shared_from_this(), error = std::move(error)] {
    self->room_ = nullptr;
    self->handshake_.refused();
    self->say(error);
  });
}

void Session::end(protocol::Bye bye) {
  asio::post(socket_.get_executor(),
             [self = shared_from_this(), bye = std::move(bye)] { self->say_bye({}, bye, kShutdownLinger); });
}

}  // namespace woodlouse::server
