#include "server/timing/steady_timekeeper.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/system/error_code.hpp>

#include <utility>

namespace woodlouse::server {
namespace {

class SteadyAlarm final : public Alarm {
 public:
  explicit SteadyAlarm(boost::asio::any_io_executor executor) : timer_(std::move(executor)) {}

  void set(Time until, Handler handler) override {
    timer_.expires_at(until);
    timer_.async_wait([handler = std::move(handler)](const boost::system::error_code& error) {
      handler(error.failed());  // a wait fails only by being cancelled
    });
  }
  void cancel() override { timer_.cancel(); }

 private:
  boost::asio::steady_timer timer_;
};

}  // namespace

std::unique_ptr<Alarm> SteadyTimekeeper::make_alarm(boost::asio::any_io_executor executor) {
  return std::make_unique<SteadyAlarm>(std::move(executor));
}

}  // namespace woodlouse::server
