// The clients that a load must not disturb, in a thread of their own: what the load costs this tool does not
// show in their times.
#pragma once

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <future>
#include <memory>
#include <thread>

#include "bench/swarm/group.h"

namespace woodlouse::swarm {

class Healthy {
 public:
  explicit Healthy(const Options& options);
  ~Healthy();
  Healthy(const Healthy&) = delete;
  Healthy& operator=(const Healthy&) = delete;

  /// Until all have joined or for a while; true: all have.
  bool join(const std::vector<Bot::Tcp::endpoint>& servers);
  void begin_measuring();
  /// What all got since they were asked last.
  Tally harvest();
  /// The last harvest.
  Tally end_measuring();
  /// After it bots() may be read.
  void stop();
  [[nodiscard]] const Bots& bots() const { return bots_; }

 private:
  /// What `work` returns in the clients' thread.
  template <typename Work>
  auto within(Work work) {
    auto task = std::make_shared<std::packaged_task<decltype(work())()>>(std::move(work));
    boost::asio::post(context_, [task] { (*task)(); });
    return task->get_future().get();
  }

  boost::asio::io_context context_{1};
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
  Bots bots_;
  std::thread thread_;
};

}  // namespace woodlouse::swarm
