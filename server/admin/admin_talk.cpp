#include "server/admin/admin_talk.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include <cassert>
#include <utility>

#include "server/admin/admin_request.h"
#include "server/admin/answer.h"
#include "server/admin/command.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

bool is_http(char first) { return first >= 'A' && first <= 'Z'; }

constexpr std::string_view kTooOften = "too many wrong tokens: none is looked at for some seconds";

}  // namespace

AdminTalk::AdminTalk(AdminPort::Socket socket, Control& control, AdminWatch& watch, Timekeeper& timekeeper)
    : socket_(std::move(socket)),
      control_(control),
      watch_(watch),
      timekeeper_(timekeeper),
      alarm_(timekeeper.make_alarm(socket_.get_executor())),
      is_trusted_(!watch.needs_token()) {}

void AdminTalk::start(std::function<void()> closed) {
  closed_ = std::move(closed);
  end_at(timekeeper_.now() + kFirstPatience);
  read();
}

void AdminTalk::start_refused(std::string line, std::function<void()> closed) {
  closed_ = std::move(closed);
  write(std::move(line), true);
}

void AdminTalk::end() {
  if (state_ == State::kClosed) return;
  if (state_ == State::kReading) return close();
  if (state_ == State::kWorking) write(refused(protocol::code::kShutdown, "the server stops"), true);
  is_last_ = true;
  linger_ = kShutdownLinger;
  end_at(timekeeper_.now() + linger_);
}

void AdminTalk::read() {
  assert(state_ == State::kReading || state_ == State::kDraining);
  socket_.async_read_some(
      asio::buffer(incoming_),
      [self = shared_from_this()](const error_code& error, std::size_t size) { self->on_read(error, size); });
}

void AdminTalk::on_read(const error_code& error, std::size_t size) {
  if (state_ == State::kClosed) return;
  if (error) return close();
  if (state_ == State::kDraining) return read();
  assert(state_ == State::kReading);
  unread_.append(incoming_.data(), size);
  take();
}

void AdminTalk::take() {
  if (unread_.empty()) return read();
  is_http(unread_.front()) ? take_request() : take_line();
}

void AdminTalk::take_line() {
  const std::size_t end = unread_.find('\n');
  if (end == std::string::npos ? unread_.size() > kMostCommandBytes : end > kMostCommandBytes)
    return write(refused(protocol::code::kLineTooLong,
                         "a line is longer than " + std::to_string(kMostCommandBytes) + " bytes"),
                 true);
  if (end == std::string::npos) return read();
  std::string text = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  if (text.ends_with('\r')) text.pop_back();
  auto line = decode_command(text);
  // Who has not shown who he is gets one try a connection.
  if (!line) return write(refused(line.error().code, line.error().text), !is_trusted_);
  if (!is_trusted_) {
    const auto verdict = watch_.judge(line->token, timekeeper_.now());
    if (verdict == AdminWatch::Verdict::kLimited)
      return write(refused(protocol::code::kRateLimited, kTooOften), true);
    if (verdict == AdminWatch::Verdict::kWrong)
      return write(refused(admin_code::kBadToken, "this door needs the right `token`: --token-file FILE"),
                   true);
    is_trusted_ = true;
  }
  state_ = State::kWorking;
  alarm_->cancel();
  control_.carry_out(std::move(line->command),
                     [talk = weak_from_this(), executor = socket_.get_executor()](std::string answer) {
                       asio::post(executor, [talk, answer = std::move(answer)]() mutable {
                         const auto self = talk.lock();
                         if (self && self->state_ == State::kWorking) self->write(std::move(answer), false);
                       });
                     });
}

void AdminTalk::take_request() {
  const std::size_t end = unread_.find("\r\n\r\n");
  const bool is_too_long =
      end == std::string::npos ? unread_.size() > kMostAdminHeadBytes : end + 4 > kMostAdminHeadBytes;
  if (is_too_long) return write(response_text(refusal(431, "a head has at most 8192 bytes"), false), true);
  if (end == std::string::npos) return read();
  const auto request = read_request(std::string_view(unread_).substr(0, end + 4));
  if (!request) return write(response_text(request.error(), false), true);
  // Whether it serves at all may be asked by who has no token.
  if (!is_trusted_ && request->path != "/healthz") {
    if (request->token.empty())  // no guess: a page that a browser shows may ask so
      return write(response_text(refusal(401, "Authorization: Bearer TOKEN is needed"), request->is_head),
                   true);
    const auto verdict = watch_.judge(request->token, timekeeper_.now());
    if (verdict == AdminWatch::Verdict::kLimited)
      return write(response_text(refusal(429, kTooOften), request->is_head), true);
    if (verdict == AdminWatch::Verdict::kWrong)
      return write(response_text(refusal(401, "Authorization: Bearer TOKEN is needed"), request->is_head),
                   true);
    is_trusted_ = true;
  }
  write(response_text(control_.page(request->path), request->is_head), true);
}

void AdminTalk::write(std::string text, bool is_last) {
  assert(state_ != State::kWriting && state_ != State::kClosed && !text.empty());
  state_ = State::kWriting;
  is_last_ = is_last;
  outgoing_ = std::move(text);
  end_at(timekeeper_.now() + kWritePatience);
  asio::async_write(
      socket_, asio::buffer(outgoing_),
      [self = shared_from_this()](const error_code& error, std::size_t) { self->on_written(error); });
}

void AdminTalk::on_written(const error_code& error) {
  if (state_ == State::kClosed) return;
  if (error) return close();
  if (is_last_) return drain();
  state_ = State::kReading;
  end_at(timekeeper_.now() + kIdle);
  take();
}

/// Closing with unread bytes would take the answer with it.
void AdminTalk::drain() {
  state_ = State::kDraining;
  error_code gone;
  socket_.shutdown(AdminPort::Socket::shutdown_send, gone);
  if (gone) return close();
  end_at(timekeeper_.now() + linger_);
  read();
}

void AdminTalk::close() {
  if (state_ == State::kClosed) return;
  state_ = State::kClosed;
  alarm_->cancel();
  error_code ignored;  // closed all the same
  socket_.close(ignored);
  std::exchange(closed_, nullptr)();
}

void AdminTalk::end_at(Time until) {
  until_ = until;
  alarm_->set(until, [talk = weak_from_this()](bool cancelled) {
    const auto self = talk.lock();
    if (self && !cancelled && self->timekeeper_.now() >= self->until_) self->close();
  });
}

}  // namespace woodlouse::server
