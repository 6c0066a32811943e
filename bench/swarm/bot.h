// One connection that joins, steers at random and counts what it gets.
#pragma once

#include <array>
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

#include "bench/swarm/options.h"
#include "bench/swarm/samples.h"
#include "shared/core/random.h"
#include "shared/protocol/framing.h"
#include "shared/protocol/messages.h"

namespace woodlouse::swarm {

/// What one bot got while it was measured.
struct Tally {
  std::uint64_t distinct_ticks = 0;
  std::uint64_t bytes = 0;
  std::uint64_t inputs = 0;
  std::uint64_t acks = 0;
  Samples input_to_ack;
  Samples frame_gaps;
};

/// Lives on one io_context, in one thread; outlives the run of that context.
class Bot {
 public:
  using Clock = std::chrono::steady_clock;
  using Tcp = boost::asio::ip::tcp;
  enum class State { kIdle, kJoining, kJoined, kLeaving, kClosed };

  Bot(boost::asio::io_context& context, const Options& options, std::size_t number);

  void start(const Tcp::resolver::results_type& endpoints);
  void begin_measuring();
  void end_measuring() { measuring_ = false; }
  void leave();
  void close();

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const Tally& tally() const { return tally_; }
  [[nodiscard]] const std::optional<protocol::Welcome>& welcome() const { return welcome_; }
  /// Why it could not join or was disconnected; empty: it was not.
  [[nodiscard]] const std::string& loss() const { return loss_; }
  /// Errors and notices of the server by code.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& complaints() const { return complaints_; }

 private:
  void read();
  void take_lines(Clock::time_point now);
  void take_frame(std::uint64_t tick, Clock::time_point now);
  void take(const protocol::ServerMessage& message, Clock::time_point now);
  void take_ack(const protocol::Ack& ack, Clock::time_point now);
  void steer_later();
  void steer();
  protocol::Input random_input();
  void send(const protocol::ClientMessage& message);
  void flush();
  void lose(std::string reason);

  struct Sent {
    std::uint32_t seq;
    Clock::time_point time;
  };
  static constexpr std::size_t kMaxAwaited = 1024;  ///< inputs without an ack; older ones are forgotten
  static constexpr std::size_t kMaxUnsentBytes = 1 << 20;  ///< past it the server takes nothing any more

  const Options& options_;
  std::size_t number_;
  core::Random random_;
  Tcp::socket socket_;
  boost::asio::steady_timer steering_;
  protocol::LineFramer framer_{protocol::kMaxServerLineBytes};
  std::array<char, 1 << 16> incoming_{};
  std::string sending_, unsent_;
  State state_ = State::kIdle;
  bool measuring_ = false;
  std::optional<protocol::Welcome> welcome_;
  std::uint32_t seq_ = 0;
  std::deque<Sent> awaited_;
  std::optional<std::uint64_t> last_tick_;
  std::optional<Clock::time_point> last_frame_;
  Tally tally_;
  std::string loss_;
  std::map<std::string, std::uint64_t> complaints_;
};

}  // namespace woodlouse::swarm
