// The time of the system's monotonic clock.
#pragma once

#include <memory>

#include "server/timing/timekeeper.h"

namespace woodlouse::server {

class SteadyTimekeeper final : public Timekeeper {
 public:
  [[nodiscard]] Time now() const override { return Clock::now(); }
  [[nodiscard]] std::unique_ptr<Alarm> make_alarm(boost::asio::any_io_executor executor) override;
};

}  // namespace woodlouse::server
