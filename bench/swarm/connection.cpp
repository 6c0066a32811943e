#include "bench/swarm/connection.h"

#include <netinet/in.h>

#include <boost/asio/write.hpp>

#include <array>
#include <utility>

#include "shared/protocol/messages.h"

namespace woodlouse::swarm {
namespace {

using boost::system::error_code;

constexpr int kSmallBuffer = 4096;

using BindLater = boost::asio::detail::socket_option::boolean<IPPROTO_IP, IP_BIND_ADDRESS_NO_PORT>;

thread_local std::array<char, 1 << 16> incoming;

}  // namespace

Connection::Connection(boost::asio::io_context& context, ConnectionUser& user, bool cuts_lines)
    : user_(user),
      cuts_lines_(cuts_lines),
      socket_(context),
      retry_(context),
      cutter_(protocol::kMaxServerLineBytes) {}

void Connection::open(const Route& route) {
  route_ = route;
  attempts_ = 0;
  is_open_ = is_reading_ = true;
  cutter_.reset();
  sending_.clear();
  unsent_.clear();
  connect();
}

error_code Connection::prepare(const Tcp::endpoint& server) {
  error_code error, ignored_where_unsupported;
  socket_.open(server.protocol(), error);
  if (error) return error;
  if (route_.has_small_buffer)  // before it connects: the window is settled then
    socket_.set_option(Tcp::socket::receive_buffer_size(kSmallBuffer), ignored_where_unsupported);
  if (route_.from && server.address().is_v4() && server.address().is_loopback()) {
    socket_.set_option(BindLater(true), ignored_where_unsupported);
    socket_.bind({*route_.from, 0}, error);
  }
  return error;
}

void Connection::connect() {
  const std::uint64_t generation = ++generation_;
  const Tcp::endpoint server = route_.servers[attempts_ % route_.servers.size()];
  if (const error_code error = prepare(server)) return lose("connect: " + error.message());
  socket_.async_connect(server, [this, generation](error_code error) {
    if (generation != generation_ || !is_open_) return;
    if (error) return on_connect_failed(error);
    is_connected_ = true;
    error_code ignored_where_unsupported;  // without it inputs are only later
    socket_.set_option(Tcp::no_delay(true), ignored_where_unsupported);
    socket_.non_blocking(true, ignored_where_unsupported);
    if (!unsent_.empty()) flush();
    wait_to_read();
  });
}

void Connection::on_connect_failed(const error_code& error) {
  error_code nothing_to_do_about_it;
  socket_.close(nothing_to_do_about_it);
  if (++attempts_ % route_.servers.size() != 0) return connect();
  if (attempts_ / route_.servers.size() > route_.retries) return lose("connect: " + error.message());
  ++retried_;
  retry_.expires_after(kBeforeRetry);
  retry_.async_wait([this, generation = generation_](error_code cancelled) {
    if (!cancelled && generation == generation_ && is_open_) connect();
  });
}

void Connection::wait_to_read() {
  socket_.async_wait(Tcp::socket::wait_read, [this, generation = generation_](error_code error) {
    if (generation != generation_ || !is_open_ || !is_reading_) return;
    if (error) return lose("read: " + error.message());
    read();
  });
}

void Connection::read() {
  error_code error;
  const std::size_t size = socket_.read_some(boost::asio::buffer(incoming), error);
  if (error && error != boost::asio::error::would_block) return lose("read: " + error.message());
  received_ += size;
  const std::uint64_t generation = generation_;
  const auto is_wanted = [&] { return is_open_ && is_reading_ && generation == generation_; };
  if (cuts_lines_) {
    const auto now = Clock::now();
    const bool is_whole = cutter_.cut({incoming.data(), size}, [&](std::string_view line) {
      return user_.on_line(line, now) && is_wanted();
    });
    if (!is_whole && is_wanted())
      return lose("a line of more than " + std::to_string(protocol::kMaxServerLineBytes) + " bytes");
  }
  if (is_wanted()) wait_to_read();
}

void Connection::send(std::string_view lines) {
  if (!is_open_) return;
  unsent_ += lines;
  if (unsent_.size() > kMaxUnsentBytes) return lose("the server takes nothing any more");
  if (is_connected_ && sending_.empty()) flush();
}

void Connection::flush() {
  std::swap(sending_, unsent_);
  boost::asio::async_write(socket_, boost::asio::buffer(sending_),
                           [this, generation = generation_](error_code error, std::size_t size) {
                             if (generation != generation_ || !is_open_) return;
                             sent_ += size;
                             sending_.clear();
                             // A failing write: the read that is under way brings the reason, the server's
                             // bye before it.
                             if (!error && !unsent_.empty()) flush();
                           });
}

void Connection::abort() {
  error_code nothing_to_do_about_it;
  socket_.set_option(Tcp::socket::linger(true, 0), nothing_to_do_about_it);
  close();
}

void Connection::close() {
  ++generation_;
  is_open_ = is_connected_ = false;
  retry_.cancel();
  error_code nothing_to_do_about_it;
  socket_.close(nothing_to_do_about_it);
}

void Connection::lose(std::string reason) {
  close();
  user_.on_lost(std::move(reason));
}

}  // namespace woodlouse::swarm
