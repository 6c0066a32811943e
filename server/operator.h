// What an operator asks of the running server (admin/control.h): it is carried out on the server's strand,
// and on those of the rooms.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/access/doorman.h"
#include "server/admin/control.h"
#include "server/metrics/metrics.h"
#include "server/moderation.h"
#include "server/room/directory.h"
#include "server/room/lobby.h"
#include "server/room_control.h"
#include "server/timing/figures.h"
#include "server/timing/timekeeper.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class Operator final : public Control {
 public:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;

  static constexpr std::uint64_t kDrainSeconds = 60;  ///< where nothing is said

  /// Told what was read again, or what could not be.
  using Reloaded = std::function<void(const core::Expected<std::string>& what)>;

  /// What it needs of the server; each is called on the server's strand, and returns at once.
  struct Server {
    const Directory& directory;
    RoomControl& rooms;
    Moderation& people;
    Doorman& doorman;
    std::function<void(Reloaded done)> reload;
    std::function<void(const std::string& text, const std::string& reason)> stop;
    std::function<bool()> is_stopping;
  };

  /// All outlive it.
  Operator(const Strand& strand, Lobby& lobby, const TrafficMetrics& traffic, Timekeeper& timekeeper,
           const Metrics& metrics, Server server, std::shared_ptr<spdlog::logger> log);

  void carry_out(Command command, Answered answered) override;
  /// Of a moderator in that room; who: he himself, for the log. Any thread.
  void moderate(protocol::Moderate wish, std::string room, std::string who,
                std::function<void(protocol::ServerMessage)> answered);
  [[nodiscard]] WebAnswer page(std::string_view path) const override;

 private:
  void dispatch(const Command& command, Answered answered);
  [[nodiscard]] std::string status() const;
  [[nodiscard]] std::string rooms() const;
  void reload(const Answered& answered);
  void drain(const Command& command, const Answered& answered);
  void shut_down(const Answered& answered);

  Strand strand_;
  Lobby& lobby_;
  const TrafficMetrics& traffic_;
  Timekeeper& timekeeper_;
  const Metrics& metrics_;
  Server server_;
  std::shared_ptr<spdlog::logger> log_;
  const Time begun_;
  boost::asio::steady_timer drained_;
};

}  // namespace woodlouse::server
