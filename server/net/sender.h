// Writes to one client what waits for it: at once what the system takes, the rest in one write in flight.
#pragma once

#include <boost/system/error_code.hpp>

#include <cstddef>
#include <memory>

#include "server/net/outbox.h"
#include "server/net/wire.h"
#include "server/room/lanes.h"
#include "server/timing/figures.h"

namespace woodlouse::server {

/// Called on the lane only.
class Sender {
 public:
  class Owner {
   public:
    virtual ~Owner() = default;
    /// Keeps the owner, and so the sender, as long as it is held.
    [[nodiscard]] virtual std::shared_ptr<void> keep() = 0;
    /// Bytes have gone out.
    virtual void on_sent() = 0;
    /// Nothing waits any more.
    virtual void on_all_sent() = 0;
    /// The connection is broken.
    virtual void on_broken() = 0;
  };

  /// All of them outlive it. limit: of the outbox.
  Sender(Owner& owner, Wire& wire, const Lane& lane, std::size_t limit, TrafficMetrics& traffic)
      : owner_(owner), wire_(wire), lane_(lane), outbox_(limit), traffic_(traffic) {}

  [[nodiscard]] Outbox& outbox() { return outbox_; }
  /// Writes what waits, together with what else comes by then: one write for the answers to all lines of a
  /// read.
  void write_soon();
  void write();
  /// Nothing goes out any more.
  void stop() { is_stopped_ = true; }

 private:
  void on_written(const boost::system::error_code& error, std::size_t bytes);
  void count(std::size_t bytes);

  Owner& owner_;
  Wire& wire_;
  const Lane& lane_;
  Outbox outbox_;
  TrafficMetrics& traffic_;
  Outbox::Batch writing_;    ///< in flight; empty: none
  bool will_write_ = false;  ///< write() is posted
  bool is_stopped_ = false;
};

}  // namespace woodlouse::server
