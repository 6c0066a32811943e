#include "client/play/session.h"

#include <string>
#include <utility>
#include <variant>

#include "client/net/unreachable.h"
#include "client/terminal/terminal_guard.h"
#include "shared/core/joined.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::client {
namespace {

/// Whoever vanishes without it leaves a louse that waits for him.
void say_good_bye_by_signal(int socket) {
  static const std::string kLeave = protocol::encode(protocol::ClientMessage(protocol::Leave{}));
  TerminalGuard::set_last_words(socket, kLeave);
}

}  // namespace

Session::Session(boost::asio::io_context& context, const Address& address, protocol::Join join)
    : context_(context), connection_(context, address, std::move(join), *this), told_(address) {}

core::Expected<void> Session::join() {
  const core::Time begin = std::chrono::steady_clock::now();
  connection_.start();
  context_.restart();
  while (is_trying()) context_.run_one();
  join_time_ =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin);
  if (connection_.phase() == Connection::Phase::kJoined) return {};
  return tl::unexpected(why_not_joined(connection_.address(), connection_.closing()));
}

void Session::update(core::Time now) {
  room_.update(now);
  for (const protocol::ClientMessage& message : room_.take_outgoing()) connection_.send(message);
}

Session::~Session() { say_good_bye_by_signal(-1); }

void Session::leave() {
  say_good_bye_by_signal(-1);
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
  const auto* const welcome = std::get_if<protocol::Welcome>(&message);
  if (welcome != nullptr) say_good_bye_by_signal(connection_.descriptor());
  const auto taken = room_.on_message(message, arrival);
  if (welcome != nullptr) tell_where(*welcome, arrival);
  for (const protocol::ClientMessage& answer : room_.take_outgoing()) connection_.send(answer);
  if (taken) return;
  failure_ = taken.error();
  connection_.stop();
}

void Session::tell_where(const protocol::Welcome& welcome, core::Time now) {
  if (connection_.address() == told_) return;
  told_ = connection_.address();
  const std::string& louse = room_.notice_line();  // what became of it, the picture shows, too
  room_.notice(core::joined({"room ", welcome.room, " is at ", told_.text(), " now",
                             louse.empty() ? "" : "; ", louse}),
               now);
}

void Session::on_recorded(std::string_view line, core::Time arrival) {
  if (room_.follow(line, arrival)) return;
  // What is shown from here on is the server's word, but it is the room.
  say_good_bye_by_signal(-1);
  connection_.watch_by_frames();
  room_.on_lost();
}

void Session::on_lost() {
  say_good_bye_by_signal(-1);
  room_.on_lost();
  if (connection_.phase() == Connection::Phase::kStopped && connection_.was_joined()) failure_ = farewell();
}

core::Error Session::farewell() const {
  const Closing& closing = connection_.closing();
  const std::string& room = connection_.room();
  const std::string again = "woodlouse " + connection_.address().text() + (room.empty() ? "" : "/" + room);
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
