#include "bots/cpp/line_client.h"

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>
#include <cassert>
#include <charconv>
#include <random>
#include <thread>
#include <utility>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::bots {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

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

core::Expected<protocol::Welcome> LineClient::join(const protocol::HostAddress& address,
                                                   const protocol::Join& join) {
  asked_ = address;
  places_.emplace(address);
  joined_at_.reset();
  join_ = join;
  return try_until_joined(Trying::kToJoin);
}

core::Expected<protocol::Welcome> LineClient::join(const std::string& host, const std::string& port,
                                                   const protocol::Join& wanted) {
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc() || end != port.data() + port.size() || number == 0)
    return core::fail(host + ":" + port, "\"" + port + "\" is no port", "a number from 1 to 65535");
  return join({host, number}, wanted);
}

core::Expected<protocol::Welcome> LineClient::come_back() {
  assert(join_.may_resume && places_);
  if (!follows()) std::this_thread::sleep_for(wait());
  return try_until_joined(Trying::kToComeBack);
}

core::Expected<protocol::Welcome> LineClient::try_until_joined(Trying trying) {
  const bool was_here = trying == Trying::kToComeBack;
  const auto until = Clock::now() + kComesBackFor;
  for (;;) {
    auto welcome = connect_and_join(was_here ? kPatience : kSilence);
    if (welcome) return welcome;
    const auto sent_to = moved_to_;
    if (follows()) continue;
    if (sent_to && protocol::parse_host_address(*sent_to))
      welcome = core::fail(std::string(protocol::code::kMoved),
                           "sent on from server to server, to " + *sent_to + " last");
    const std::string& code = welcome.error().where;
    const bool is_without_it = code == protocol::code::kUnknownRoom || code == protocol::code::kShutdown;
    const bool passes = code == protocol::code::kRateLimited ||
                        (was_here && (is_broken_ || code == protocol::code::kTooManyConnections ||
                                      (is_without_it && places_->has_others())));
    const auto next = Clock::now() + std::max<Clock::duration>(wait(), retry_after_);
    if (!passes || next > until) return welcome;
    std::this_thread::sleep_until(next);
  }
}

/// It is meant for the server that was asked for; to another machine's it would go as plain text.
bool LineClient::may_say_password() const {
  boost::system::error_code is_a_name;
  const auto number = asio::ip::make_address(address().host, is_a_name);
  return address() == asked_ || (is_a_name ? address().host == "localhost" : number.is_loopback());
}

/// Whether it goes where it was sent.
bool LineClient::follows() {
  if (!moved_to_) return false;
  const auto there = std::exchange(moved_to_, std::nullopt);
  const auto up_for = joined_at_ ? std::optional(seconds_since(*joined_at_)) : std::nullopt;
  if (places_->moved(*there, up_for) != protocol::Whereabouts::Sent::kFollows) return false;
  joined_at_.reset();
  return true;
}

/// Before it is tried again, after an attempt or a line that was lost.
Clock::duration LineClient::wait() {
  std::random_device device;
  const double chance = std::generate_canonical<double, 32>(device);
  const auto up_for = joined_at_ ? std::optional(seconds_since(*joined_at_)) : std::nullopt;
  joined_at_.reset();
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(places_->lost(up_for, chance)));
}

core::Expected<protocol::Welcome> LineClient::connect_and_join(std::chrono::seconds patience) {
  if (auto connected = connect(); !connected) return tl::unexpected(connected.error());
  protocol::Join join = join_;
  if (!may_say_password()) join.token.clear();
  if (auto sent = send(join); !sent) return tl::unexpected(sent.error());
  for (;;) {
    const auto message = receive(patience);
    if (!message) return tl::unexpected(message.error());
    if (const auto* refusal = std::get_if<protocol::ErrorMessage>(&*message)) {
      retry_after_ = std::chrono::milliseconds(refusal->retry_after_ms.value_or(0));
      if (refusal->code == protocol::code::kMoved) return moved(refusal->text, refusal->address);
      return core::fail(refusal->code, refusal->text);
    }
    if (const auto* bye = std::get_if<protocol::Bye>(&*message)) return core::fail(bye->code, bye->text);
    const auto* welcome = std::get_if<protocol::Welcome>(&*message);
    if (!welcome) continue;
    return *welcome;
  }
}

core::Expected<void> LineClient::connect() {
  framer_ = protocol::LineFramer(protocol::kMaxServerLineBytes);
  is_broken_ = false;
  moved_to_.reset();
  retry_after_ = {};
  hosts_.clear();
  boost::system::error_code error;
  socket_.close(error);
  const std::string port = std::to_string(address().port);
  const auto endpoints = asio::ip::tcp::resolver(context_).resolve(address().host, port, error);
  if (!error) {
    asio::async_connect(socket_, endpoints,
                        [&error](const boost::system::error_code& failed, const asio::ip::tcp::endpoint&) {
                          error = failed;
                        });
    run(kPatience);
  }
  if (!error) socket_.set_option(asio::ip::tcp::no_delay(true), error);
  if (error) return broken(address().text(), error.message(), "is woodlouse-server running there?");
  return {};
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
        if (const auto* hello = std::get_if<protocol::Hello>(&*message)) hosts_ = hello->hosts;
        if (const auto* ping = std::get_if<protocol::Ping>(&*message); ping && ping->hosts) {
          hosts_ = *ping->hosts;
          if (joined_at_) places_->welcomed(hosts_);
        }
        if (const auto* welcome = std::get_if<protocol::Welcome>(&*message)) take(*welcome);
        const auto* bye = std::get_if<protocol::Bye>(&*message);
        if (bye != nullptr && bye->code == protocol::code::kMoved) return moved(bye->text, bye->address);
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
  join_.room = welcome.room;  // the first one of another server may be another
  if (!joined_at_) joined_at_ = Clock::now();
  places_->welcomed(hosts_);
}

/// What ended it, in words: come_back() may follow.
tl::unexpected<core::Error> LineClient::moved(const std::string& text, const std::string& address) {
  is_broken_ = true;
  moved_to_ = address;
  if (address.empty() || protocol::parse_host_address(address))
    return core::fail(std::string(protocol::code::kMoved), text);
  return core::fail(std::string(protocol::code::kMoved),
                    "the room has moved to \"" + address + "\", which is no HOST:PORT");
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
