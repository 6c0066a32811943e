// What time it is and when to ring, so that a test can be the clock.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/function.hpp>

#include <memory>

#include "server/timing/clock.h"

namespace woodlouse::server {

/// Rings once at a set time. Used on its executor only, a strand where several threads run it.
class Alarm {
 public:
  /// Called on the alarm's executor, never within set() or cancel(). cancelled: by cancel(), another set() or
  /// the alarm's end; a ring that was due by then may still come as one. What captures 24 bytes at most costs
  /// no memory.
  using Handler = boost::function<void(bool cancelled)>;

  Alarm() = default;
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;
  virtual ~Alarm() = default;

  /// Rings as soon as it is `until`, in place of what was set before. The handler is kept until it is called,
  /// or until the executor's context ends.
  virtual void set(Time until, Handler handler) = 0;
  virtual void cancel() = 0;
};

/// Any thread.
class Timekeeper {
 public:
  Timekeeper() = default;
  Timekeeper(const Timekeeper&) = delete;
  Timekeeper& operator=(const Timekeeper&) = delete;
  virtual ~Timekeeper() = default;

  /// Never goes back.
  [[nodiscard]] virtual Time now() const = 0;
  /// Not set.
  [[nodiscard]] virtual std::unique_ptr<Alarm> make_alarm(boost::asio::any_io_executor executor) = 0;
};

}  // namespace woodlouse::server
