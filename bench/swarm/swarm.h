// The clients together: let in one after the other, measured all at once, and sent home.
#pragma once

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "bench/swarm/churn.h"
#include "bench/swarm/group.h"
#include "bench/swarm/healthy.h"
#include "bench/swarm/options.h"
#include "shared/core/error.h"

namespace woodlouse::swarm {

/// What the healthy got, one after the other.
struct HealthyTallies {
  Tally before;  ///< the load came
  Tally coming;  ///< while it came
  Tally lasts;   ///< while it was there
};

class Swarm {
 public:
  explicit Swarm(const Options& options);

  /// Joins, measures for options.seconds, leaves. Error: the host is unknown, or none could join.
  core::Expected<std::chrono::duration<double>> run();

  [[nodiscard]] const Bots& bots() const { return bots_; }
  [[nodiscard]] const Bots& healthy() const { return healthy_.bots(); }
  [[nodiscard]] const HealthyTallies& healthy_tallies() const { return healthy_tallies_; }
  [[nodiscard]] const Churn& churn() const { return churn_; }
  /// How long it took until all had joined or been refused [s].
  [[nodiscard]] double joining_seconds() const { return joining_seconds_; }
  /// CPU time this process took while it measured [s].
  [[nodiscard]] double own_cpu_seconds() const { return own_cpu_seconds_; }

 private:
  using Clock = std::chrono::steady_clock;

  core::Expected<void> let_healthy_in(const std::vector<Bot::Tcp::endpoint>& servers);
  void let_in(const std::vector<Bot::Tcp::endpoint>& servers);
  std::chrono::duration<double> measure();
  void send_home();
  /// Runs the context for that long.
  void run_for(Clock::duration duration);
  /// Runs the context until `done`, looked at now and then, or for at most `limit`.
  template <typename Done>
  void run_until(Clock::duration limit, Done done);

  const Options& options_;
  boost::asio::io_context context_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;  ///< so that it never stops
  Bots bots_;
  Churn churn_;
  Healthy healthy_;
  HealthyTallies healthy_tallies_;
  double joining_seconds_ = 0.0;
  double own_cpu_seconds_ = 0.0;
};

}  // namespace woodlouse::swarm
