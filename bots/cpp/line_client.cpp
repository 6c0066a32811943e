#include "bots/cpp/line_client.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::bots {

namespace asio = boost::asio;

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
  boost::system::error_code error;
  const auto endpoints = asio::ip::tcp::resolver(context_).resolve(host, port, error);
  if (!error) asio::connect(socket_, endpoints, error);
  if (error) return core::fail(host + ":" + port, error.message(), "is woodlouse-server running there?");
  socket_.set_option(asio::ip::tcp::no_delay(true), error);
  if (error) return core::fail(host + ":" + port, error.message());
  if (auto sent = send(join); !sent) return tl::unexpected(sent.error());
  for (;;) {
    const auto message = receive();
    if (!message) return tl::unexpected(message.error());
    if (const auto* refusal = std::get_if<protocol::ErrorMessage>(&*message))
      return core::fail(refusal->code, refusal->text);
    if (const auto* bye = std::get_if<protocol::Bye>(&*message)) return core::fail(bye->code, bye->text);
    const auto* welcome = std::get_if<protocol::Welcome>(&*message);
    if (!welcome) continue;
    fields_ = welcome->fields;
    format_ = welcome->format;
    return *welcome;
  }
}

core::Expected<void> LineClient::send(const protocol::ClientMessage& message) {
  boost::system::error_code error;
  asio::write(socket_, asio::buffer(protocol::encode(message)), error);
  if (error) return core::fail("connection", error.message());
  return {};
}

core::Expected<protocol::ServerMessage> LineClient::receive() {
  for (;;) {
    while (const auto line = framer_.next()) {
      if (line->oversize) return core::fail("server", "a line of more than 128 MiB");
      auto message = protocol::decode_server(line->text, fields_, format_);
      if (message) return std::move(*message);
      if (message.error().code != protocol::code::kUnknownType)
        return core::fail("server", message.error().text);
    }
    boost::system::error_code error;
    const std::size_t size = socket_.read_some(asio::buffer(incoming_), error);
    if (error) return core::fail("connection", error.message());
    framer_.append({incoming_.data(), size});
  }
}

}  // namespace woodlouse::bots
