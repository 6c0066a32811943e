// Clients that come, join and vanish, so many a second.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <cstdint>

#include "bench/swarm/group.h"

namespace woodlouse::swarm {

/// Lives on one io_context, in one thread; outlives the run of that context.
class Churn {
 public:
  Churn(boost::asio::io_context& context, const Options& options);

  void start(const std::vector<Bot::Tcp::endpoint>& servers);
  void stop();

  /// Who has been sent, one client counted each time.
  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  /// Who should have been sent, but all kMost were still joining.
  [[nodiscard]] std::uint64_t kept_back() const { return kept_back_; }
  [[nodiscard]] const Bots& bots() const { return bots_; }

 private:
  void send_next();
  Bot* find_idle();

  static constexpr std::size_t kMost = 200;  ///< at once

  boost::asio::io_context& context_;
  const Options& options_;
  boost::asio::steady_timer timer_;
  std::vector<Bot::Tcp::endpoint> servers_;
  Bot::Clock::time_point begin_{};
  Bots bots_;
  std::uint64_t sent_ = 0, kept_back_ = 0;
};

}  // namespace woodlouse::swarm
