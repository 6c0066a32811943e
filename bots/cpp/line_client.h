// A blocking connection that speaks the codec's messages: all that a bot of its own thread needs.
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
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
  static constexpr std::chrono::seconds kComesBackFor{30};  ///< a louse waits for so long
  static constexpr std::chrono::seconds kSilence{15};  ///< a server that says nothing for so long is gone
  static constexpr std::chrono::seconds kPatience{5};  ///< to connect, and at an attempt to come back

  /// Connects and joins, as soon as the server lets one more join. Errors: no server there, or why it
  /// refused.
  core::Expected<protocol::Welcome> join(const std::string& host, const std::string& port,
                                         const protocol::Join& join);
  /// Joins there once more, tried each second for kComesBackFor: Welcome::resumed says whether into the louse
  /// that it had. REQUIRES a join before, with Join::may_resume.
  core::Expected<protocol::Welcome> come_back();
  /// Whether the last error was the connection's: who joined may come back.
  [[nodiscard]] bool is_broken() const { return is_broken_; }
  core::Expected<void> send(const protocol::ClientMessage& message);
  /// Waits for the next message that this version knows. Errors: the connection ended, a line out of shape.
  core::Expected<protocol::ServerMessage> receive();

 private:
  enum class Trying { kToJoin, kToComeBack };

  core::Expected<protocol::Welcome> try_until_joined(Trying trying);
  core::Expected<protocol::Welcome> connect_and_join(std::chrono::seconds patience);
  core::Expected<protocol::ServerMessage> receive(std::chrono::seconds patience);
  void take(const protocol::Welcome& welcome);
  void run(std::chrono::seconds patience);
  tl::unexpected<core::Error> broken(const std::string& where, const std::string& what,
                                     const std::string& hint = {});

  std::string host_, port_;
  protocol::Join join_;  ///< with the token of the louse that it has, or had
  bool is_broken_ = false;
  std::chrono::milliseconds retry_after_{0};  ///< of the last refusal
  boost::asio::io_context context_;
  boost::asio::ip::tcp::socket socket_{context_};
  protocol::LineFramer framer_{protocol::kMaxServerLineBytes};
  std::array<char, 1 << 16> incoming_{};
  std::vector<protocol::Column> fields_;
  protocol::Format format_ = protocol::Format::kQuantized;
};

}  // namespace woodlouse::bots
