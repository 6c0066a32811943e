#include "server/net/tls_wire.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

class TlsWire final : public Wire {
 public:
  explicit TlsWire(std::unique_ptr<TlsConnection> connection) : connection_(std::move(connection)) {
    assert(connection_ != nullptr);
  }

  void read_some(std::span<char> into, Handler handler) override {
    std::string& first = connection_->first;
    if (first.empty())
      return connection_->stream.async_read_some(asio::buffer(into.data(), into.size()), std::move(handler));
    const std::size_t size = std::min(into.size(), first.size());
    std::copy_n(first.begin(), size, into.begin());
    first.erase(0, size);
    asio::post(connection_->stream.get_executor(),
               [handler = std::move(handler), size] { handler({}, size); });
  }

  /// What is encrypted can't be taken back where the system has no room for it.
  [[nodiscard]] std::size_t write_now(std::span<const Line>) override { return 0; }

  void write(std::span<const Line> lines, std::size_t skipped, Handler handler) override {
    assert(!lines.empty() && skipped == 0);
    static_cast<void>(skipped);
    buffers_.clear();
    for (const Line& line : lines) buffers_.push_back(asio::buffer(*line));
    asio::async_write(connection_->stream, std::span<const asio::const_buffer>(buffers_), std::move(handler));
  }

  [[nodiscard]] error_code shut_down_sending() override {
    if (!connection_->stream.lowest_layer().is_open()) return asio::error::not_connected;
    // It goes on for a moment when we have closed, and what it is of lasts as long.
    connection_->stream.async_shutdown([kept = connection_](const error_code&) {});
    return {};
  }

  [[nodiscard]] error_code close() override {
    error_code error;
    connection_->stream.lowest_layer().close(error);
    return error;
  }

 private:
  std::shared_ptr<TlsConnection> connection_;
  std::vector<asio::const_buffer> buffers_;  ///< of the write that runs
};

}  // namespace

std::unique_ptr<Wire> make_tls_wire(std::unique_ptr<TlsConnection> connection) {
  return std::make_unique<TlsWire>(std::move(connection));
}

}  // namespace woodlouse::server
