// A blocking connection that speaks the codec's messages: all that a bot of its own thread needs.
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/protocol/framing.h"
#include "shared/protocol/messages.h"
#include "shared/protocol/whereabouts.h"

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
  /// Longer than a server left as it is keeps a louse: another one takes the room over.
  static constexpr std::chrono::seconds kComesBackFor{60};
  static constexpr std::chrono::seconds kSilence{15};  ///< a server that says nothing for so long is gone
  static constexpr std::chrono::seconds kPatience{5};  ///< to connect, and at an attempt to come back

  /// Connects and joins, as soon as the server lets one more join, and where it says that the room is.
  /// Errors: no server there, or why it refused.
  core::Expected<protocol::Welcome> join(const protocol::HostAddress& address, const protocol::Join& join);
  core::Expected<protocol::Welcome> join(const std::string& host, const std::string& port,
                                         const protocol::Join& join);
  /// Joins once more: at once where the room has moved, else where it was and at the hosts that were named
  /// there in turn, later and later for kComesBackFor. Welcome::resumed says whether into the louse that it
  /// had. REQUIRES a join before, with Join::may_resume.
  core::Expected<protocol::Welcome> come_back();
  /// Whether the last error was the connection's, or the room has moved: who joined may come back.
  [[nodiscard]] bool is_broken() const { return is_broken_; }
  /// Of the server that was joined last. REQUIRES a join before.
  [[nodiscard]] const protocol::HostAddress& address() const { return places_->place(); }
  core::Expected<void> send(const protocol::ClientMessage& message);
  /// Waits for the next message that this version knows. Errors: the connection ended, a line out of shape.
  core::Expected<protocol::ServerMessage> receive();

 private:
  enum class Trying { kToJoin, kToComeBack };

  core::Expected<protocol::Welcome> try_until_joined(Trying trying);
  core::Expected<protocol::Welcome> connect_and_join(std::chrono::seconds patience);
  core::Expected<void> connect();
  core::Expected<protocol::ServerMessage> receive(std::chrono::seconds patience);
  void take(const protocol::Welcome& welcome);
  [[nodiscard]] bool may_say_password() const;
  bool follows();
  std::chrono::steady_clock::duration wait();
  tl::unexpected<core::Error> moved(const std::string& text, const std::string& address);
  void run(std::chrono::seconds patience);
  tl::unexpected<core::Error> broken(const std::string& where, const std::string& what,
                                     const std::string& hint = {});

  protocol::HostAddress asked_;
  std::optional<protocol::Whereabouts> places_;
  std::vector<std::string> hosts_;  ///< as the server named them last
  protocol::Join join_;             ///< with the token of the louse that it has, or had
  std::optional<std::chrono::steady_clock::time_point> joined_at_;  ///< none: it is not
  bool is_broken_ = false;
  std::optional<std::string> moved_to_;  ///< of the last error, where that says so: as a stranger told it
  std::chrono::milliseconds retry_after_{0};  ///< of the last refusal
  boost::asio::io_context context_;
  boost::asio::ip::tcp::socket socket_{context_};
  protocol::LineFramer framer_{protocol::kMaxServerLineBytes};
  std::array<char, 1 << 16> incoming_{};
  std::vector<protocol::Column> fields_;
  protocol::Format format_ = protocol::Format::kQuantized;
};

}  // namespace woodlouse::bots
