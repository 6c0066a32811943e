// What an operator asks about people: kicked, banned, muted, told something.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/strand.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/access/doorman.h"
#include "server/admin/control.h"
#include "server/ban_desk.h"
#include "server/net/acceptor.h"
#include "server/room/lobby.h"

namespace woodlouse::server {

/// On the server's strand, but for the constructor.
class Moderation {
 public:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;
  using Answered = Control::Answered;

  /// Of an address, where nothing is said of its end.
  static constexpr std::chrono::hours kMuteOfAddress{1};

  /// All outlive it. desk: empty until the server has one.
  Moderation(const Strand& strand, Lobby& lobby, Acceptor& acceptor, Doorman& doorman,
             std::optional<BanDesk>& desk, std::shared_ptr<spdlog::logger> log)
      : strand_(strand),
        lobby_(lobby),
        acceptor_(acceptor),
        doorman_(doorman),
        desk_(desk),
        log_(std::move(log)) {}

  /// Who is in a room, and from where.
  void list(const Command& command, const Answered& answered);
  void kick(const Command& command, Answered answered);
  void ban(const Command& command, const Answered& answered);
  /// Any thread. Whoever is here and is banned goes; `done` is told how many, on some thread.
  void enforce_bans(std::function<void(std::size_t)> done);
  void unban(const Command& command, const Answered& answered);
  [[nodiscard]] std::string bans() const;
  void mute(const Command& command, const Answered& answered);
  void unmute(const Command& command, const Answered& answered);
  [[nodiscard]] std::string say(const Command& command);

 private:
  /// Somebody, and the room he is in.
  struct Found {
    std::shared_ptr<Room> room;
    RosterEntry entry;
  };
  using OnFound = std::function<void(std::vector<Found>)>;
  using IsMeant = std::function<bool(const RosterEntry&)>;
  /// Those in the room that is named, or in all; on the strand.
  void find(const IsMeant& is_meant, const std::string& room, OnFound on_found);
  /// Who is called so, by name or by the number of a louse, but for the house's bots; why_not: the answer
  /// where that is nobody, or not clear.
  void find_called(const std::string& who, const std::string& room,
                   std::function<void(std::vector<Found> found, std::string why_not)> on_found);
  void expel(const std::vector<Found>& found, protocol::ErrorMessage why, std::function<void()> done);
  static std::optional<WallTime> end_of(const Command& command, WallTime now) {
    if (!command.seconds) return std::nullopt;
    return now + std::chrono::seconds(static_cast<std::int64_t>(*command.seconds));
  }
  void apply(const Ban& ban, const Answered& answered);

  Strand strand_;
  Lobby& lobby_;
  Acceptor& acceptor_;
  Doorman& doorman_;
  std::optional<BanDesk>& desk_;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace woodlouse::server
