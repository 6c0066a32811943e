// One client that joins, does its task and counts what it gets.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bench/swarm/connection.h"
#include "bench/swarm/options.h"
#include "bench/swarm/profile.h"
#include "bench/swarm/tally.h"
#include "shared/core/random.h"
#include "shared/protocol/messages.h"

namespace woodlouse::swarm {

/// How it came in: the last time, where it came more than once.
struct Arrival {
  std::chrono::steady_clock::time_point connected{};
  std::optional<std::chrono::steady_clock::duration> to_welcome, to_first_frame;
};

/// How it came back after its connection was cut.
struct Comeback {
  std::uint32_t former_id = 0;
  bool is_cut = false;
  bool has_same_louse = false;  ///< the welcome's id is the former one
  bool says_resumed = false;    ///< the welcome says so itself
};

/// Lives on one io_context, in one thread; outlives the run of that context.
class Bot : private ConnectionUser {
 public:
  using Clock = std::chrono::steady_clock;
  using Tcp = boost::asio::ip::tcp;
  enum class State { kIdle, kJoining, kJoined, kLeaving, kClosed };

  Bot(boost::asio::io_context& context, const Options& options, Profile profile, std::size_t number);

  /// Also again, once it is closed.
  void start(const std::vector<Tcp::endpoint>& servers);
  void begin_measuring();
  void end_measuring();
  /// What it got since it was asked last; the gap between frames that is under way goes on.
  Tally harvest();
  /// Cuts the connection and comes back after `away`.
  void cut(Clock::duration away);
  void leave();
  void close();

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const Profile& profile() const { return profile_; }
  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] const Arrival& arrival() const { return arrival_; }
  [[nodiscard]] const Comeback& comeback() const { return comeback_; }
  [[nodiscard]] const std::optional<protocol::Welcome>& welcome() const { return welcome_; }
  [[nodiscard]] const Connection& connection() const { return connection_; }
  /// Why it could not join or was disconnected; empty: it was not.
  [[nodiscard]] const std::string& loss() const { return loss_; }
  /// Errors and notices of the server by code.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& complaints() const { return complaints_; }
  /// Joins that were refused, by code.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& refusals() const { return refusals_; }

 private:
  bool on_line(std::string_view line, Clock::time_point now) override;
  void on_lost(std::string reason) override { lose(std::move(reason)); }
  void take_frame(std::uint64_t tick, Clock::time_point now);
  void take(const protocol::ServerMessage& message, std::string_view line, Clock::time_point now);
  void take_welcome(const protocol::Welcome& welcome, std::string_view line, Clock::time_point now);
  void take_error(const protocol::ErrorMessage& error, Clock::time_point now);
  void take_ack(std::uint32_t seq, Clock::time_point now);
  void join();
  void act_later();
  void act();
  void file_inputs(std::uint64_t tick);
  void send_input(const protocol::Input& input);
  protocol::Input random_input();
  void send(const protocol::ClientMessage& message);
  void lose(std::string reason);

  struct Sent {
    std::uint32_t seq;
    Clock::time_point time;
  };
  static constexpr std::size_t kMaxAwaited = 1024;  ///< inputs without an ack; older ones are forgotten

  const Options& options_;
  Profile profile_;
  core::Random random_;
  Connection connection_;
  boost::asio::steady_timer acting_;
  std::vector<Tcp::endpoint> servers_;
  State state_ = State::kIdle;
  bool measuring_ = false;
  protocol::Limits limits_;
  std::optional<protocol::Welcome> welcome_;
  std::optional<Clock::time_point> held_until_;  ///< rate_limited says so
  bool was_held_ = false;
  std::uint32_t seq_ = 0;
  std::uint64_t filed_for_ = 0;  ///< the tick of the last inputs for one tick
  std::deque<Sent> awaited_;
  std::optional<std::uint64_t> last_tick_;
  std::optional<Clock::time_point> last_frame_;
  std::uint64_t received_before_ = 0, sent_before_ = 0;
  Tally tally_;
  Arrival arrival_;
  Comeback comeback_;
  std::string loss_;
  std::map<std::string, std::uint64_t> complaints_, refusals_;
};

}  // namespace woodlouse::swarm
