// A blocking connection that speaks the codec's messages: all that a bot of its own thread needs.
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <map>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/protocol/framing.h"
#include "shared/protocol/messages.h"

namespace woodlouse::bots {

/// The world as a client sees it: rows by id, each in the order of Welcome::fields.
class WorldView {
 public:
  /// Takes a key, or a delta to the last key. False: its key was missed, a resync is due.
  bool take(const protocol::Frame& frame);
  [[nodiscard]] const std::map<std::uint32_t, std::vector<double>>& rows() const { return rows_; }

 private:
  std::uint64_t key_tick_ = 0;
  bool has_key_ = false;
  std::map<std::uint32_t, std::vector<double>> key_, rows_;
};

class LineClient {
 public:
  /// Connects and joins. Errors: no server there, or why it refused.
  core::Expected<protocol::Welcome> join(const std::string& host, const std::string& port,
                                         const protocol::Join& join);
  core::Expected<void> send(const protocol::ClientMessage& message);
  /// Waits for the next message that this version knows. Errors: the connection ended, a line out of shape.
  core::Expected<protocol::ServerMessage> receive();

 private:
  boost::asio::io_context context_;
  boost::asio::ip::tcp::socket socket_{context_};
  protocol::LineFramer framer_{protocol::kMaxServerLineBytes};
  std::array<char, 1 << 16> incoming_{};
  std::vector<protocol::Column> fields_;
  protocol::Format format_ = protocol::Format::kQuantized;
};

}  // namespace woodlouse::bots
