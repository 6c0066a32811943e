#include "bots/cpp/line_client.h"

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>
#include <cassert>
#include <thread>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::bots {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

bool WorldView::take(const protocol::Frame& frame) {
  if (!frame.is_key && (!has_key_ || frame.base != key_tick_)) return false;
  rows_ = frame.is_key ? decltype(rows_){} : key_;
  for (const std::uint32_t id : frame.gone) rows_.erase(id);
  for (std::size_t row = 0; row < frame.rows(); ++row) {
    const auto begin = frame.values.begin() + static_cast<std::ptrdiff_t>(row * frame.columns);
    std::vector<double> values(begin, begin + static_cast<std::ptrdiff_t>(frame.columns));
    const auto id = static_cast<std::uint32_t>(values.front());
    rows_[id] = std::move(values);
  }
  if (frame.is_key) {
    key_ = rows_;
    key_tick_ = frame.tick;
    has_key_ = true;
  }
  return true;
}

core::Expected<protocol::Welcome> LineClient::join(const std::string& host, const std::string& port,
                                                   const protocol::Join& join) {
  host_ = host;
  port_ = port;
  join_ = join;
  return try_until_joined(Trying::kToJoin);
}

core::Expected<protocol::Welcome> LineClient::come_back() {
  assert(join_.may_resume);
  return try_until_joined(Trying::kToComeBack);
}

core::Expected<protocol::Welcome> LineClient::try_until_joined(Trying trying) {
  const bool was_here = trying == Trying::kToComeBack;
  const auto until = Clock::now() + kComesBackFor;
  for (;;) {
    const auto begun = Clock::now();
    auto welcome = connect_and_join(was_here ? kPatience : kSilence);
    if (welcome) return welcome;
    const std::string& code = welcome.error().where;
    const bool passes = code == protocol::code::kRateLimited ||
                        (was_here && (is_broken_ || code == protocol::code::kTooManyConnections));
    const auto next = std::max(begun + std::chrono::seconds(1), Clock::now() + retry_after_);
    if (!passes || next > until) return welcome;
    std::this_thread::sleep_until(next);
  }
}

core::Expected<protocol::Welcome> LineClient::connect_and_join(std::chrono::seconds patience) {
  framer_ = protocol::LineFramer(protocol::kMaxServerLineBytes);
  is_broken_ = false;
  retry_after_ = {};
  boost::system::error_code error;
  socket_.close(error);
  const auto endpoints = asio::ip::tcp::resolver(context_).resolve(host_, port_, error);
  if (!error) {
    asio::async_connect(socket_, endpoints,
                        [&error](const boost::system::error_code& failed, const asio::ip::tcp::endpoint&) {
                          error = failed;
                        });
    run(kPatience);
  }
  if (!error) socket_.set_option(asio::ip::tcp::no_delay(true), error);
  if (error) return broken(host_ + ":" + port_, error.message(), "is woodlouse-server running there?");
  if (auto sent = send(join_); !sent) return tl::unexpected(sent.error());
  for (;;) {
    const auto message = receive(patience);
    if (!message) return tl::unexpected(message.error());
    if (const auto* refusal = std::get_if<protocol::ErrorMessage>(&*message)) {
      retry_after_ = std::chrono::milliseconds(refusal->retry_after_ms.value_or(0));
      return core::fail(refusal->code, refusal->text);
    }
    if (const auto* bye = std::get_if<protocol::Bye>(&*message)) return core::fail(bye->code, bye->text);
    const auto* welcome = std::get_if<protocol::Welcome>(&*message);
    if (!welcome) continue;
    return *welcome;
  }
}

core::Expected<void> LineClient::send(const protocol::ClientMessage& message) {
  boost::system::error_code error;
  asio::write(socket_, asio::buffer(protocol::encode(message)), error);
  if (error) return broken("connection", error.message());
  return {};
}

core::Expected<protocol::ServerMessage> LineClient::receive() { return receive(kSilence); }

core::Expected<protocol::ServerMessage> LineClient::receive(std::chrono::seconds patience) {
  for (;;) {
    while (const auto line = framer_.next()) {
      if (line->oversize) return core::fail("server", "a line of more than 128 MiB");
      auto message = protocol::decode_server(line->text, fields_, format_);
      if (message) {
        if (const auto* welcome = std::get_if<protocol::Welcome>(&*message)) take(*welcome);
        return std::move(*message);
      }
      if (message.error().code != protocol::code::kUnknownType)
        return core::fail("server", message.error().text);
    }
    boost::system::error_code error;
    std::size_t size = 0;
    socket_.async_read_some(asio::buffer(incoming_),
                            [&](const boost::system::error_code& failed, std::size_t count) {
                              error = failed;
                              size = count;
                            });
    run(patience);
    if (error) return broken("connection", error.message());
    framer_.append({incoming_.data(), size});
  }
}

/// What follows is by its columns; of a room that plays several games each has one.
void LineClient::take(const protocol::Welcome& welcome) {
  fields_ = welcome.fields;
  format_ = welcome.format;
  join_.resume = welcome.resume_token;
}

/// Until what was begun on the socket has ended, or is given up.
void LineClient::run(std::chrono::seconds patience) {
  context_.restart();
  context_.run_for(patience);
  if (context_.stopped()) return;
  boost::system::error_code nothing_to_do_about_it;
  socket_.close(nothing_to_do_about_it);
  context_.run();
}

tl::unexpected<core::Error> LineClient::broken(const std::string& where, const std::string& what,
                                               const std::string& hint) {
  is_broken_ = true;
  return core::fail(where, what, hint);
}

}  // namespace woodlouse::bots
