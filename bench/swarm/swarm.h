// The bots together: let in one after the other, measured all at once, and sent home.
#pragma once

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include "bench/swarm/bot.h"
#include "bench/swarm/options.h"
#include "shared/core/error.h"

namespace woodlouse::swarm {

class Swarm {
 public:
  explicit Swarm(const Options& options);

  /// Joins, measures for options.seconds, leaves. Error: the host is unknown, or no bot could join.
  core::Expected<std::chrono::duration<double>> run();

  [[nodiscard]] const std::vector<std::unique_ptr<Bot>>& bots() const { return bots_; }
  /// CPU time this process took while it measured [s].
  [[nodiscard]] double own_cpu_seconds() const { return own_cpu_seconds_; }

 private:
  std::size_t count(Bot::State state) const;
  /// Runs the context until `done` or for at most `limit`.
  template <typename Done>
  void run_until(std::chrono::steady_clock::duration limit, Done done);

  const Options& options_;
  boost::asio::io_context context_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;  ///< so that it never stops
  std::vector<std::unique_ptr<Bot>> bots_;
  double own_cpu_seconds_ = 0.0;
};

}  // namespace woodlouse::swarm
