// A clock that a test moves by hand.
#pragma once

#include <boost/asio/post.hpp>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "server/timing/timekeeper.h"

namespace woodlouse::server {

/// One thread. Stands still until advance(); what is due then is posted to the executors of the alarms.
class ManualTimekeeper final : public Timekeeper {
 public:
  [[nodiscard]] Time now() const override { return *now_; }
  [[nodiscard]] std::unique_ptr<Alarm> make_alarm(boost::asio::any_io_executor executor) override {
    auto clockwork = std::make_shared<Clockwork>(Clockwork{std::move(executor), {}, {}});
    alarms_.push_back(clockwork);
    return std::make_unique<ManualAlarm>(std::move(clockwork), now_);
  }

  void advance(Duration by) {
    *now_ += by;
    for (const auto& alarm : alarms_)
      if (const auto clockwork = alarm.lock(); clockwork && clockwork->until <= *now_) clockwork->end(false);
  }
  /// How many alarms are set.
  [[nodiscard]] std::size_t pending() const {
    return static_cast<std::size_t>(std::count_if(alarms_.begin(), alarms_.end(), [](const auto& alarm) {
      const auto clockwork = alarm.lock();
      return clockwork && !clockwork->handler.empty();
    }));
  }

 private:
  struct Clockwork {
    boost::asio::any_io_executor executor;
    Time until;
    Alarm::Handler handler;  ///< empty: not set

    void end(bool cancelled) {
      if (handler.empty()) return;
      boost::asio::post(executor, [ring = std::exchange(handler, {}), cancelled] { ring(cancelled); });
    }
  };

  class ManualAlarm final : public Alarm {
   public:
    ManualAlarm(std::shared_ptr<Clockwork> clockwork, std::shared_ptr<const Time> now)
        : clockwork_(std::move(clockwork)), now_(std::move(now)) {}
    ~ManualAlarm() override { clockwork_->end(true); }

    void set(Time until, Handler handler) override {
      clockwork_->end(true);
      clockwork_->until = until;
      clockwork_->handler = std::move(handler);
      if (until <= *now_) clockwork_->end(false);
    }
    void cancel() override { clockwork_->end(true); }

   private:
    std::shared_ptr<Clockwork> clockwork_;
    std::shared_ptr<const Time> now_;
  };

  std::shared_ptr<Time> now_ = std::make_shared<Time>(std::chrono::hours(1));
  std::vector<std::weak_ptr<Clockwork>> alarms_;
};

}  // namespace woodlouse::server
