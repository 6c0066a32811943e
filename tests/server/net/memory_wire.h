// A connection in memory: a session holds the wire, the test its other end.
#pragma once

#include <boost/asio/error.hpp>
#include <boost/asio/post.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/net/wire.h"

namespace woodlouse::server {

/// What the session's peer and the network do, and what they see. One thread.
class FarEnd : public std::enable_shared_from_this<FarEnd> {
 public:
  using error_code = boost::system::error_code;

  explicit FarEnd(boost::asio::any_io_executor executor) : executor_(std::move(executor)) {}

  // What a test decides:
  bool holds_writes = false;          ///< writes stay in flight until let_go()
  std::size_t takes_at_once = 0;      ///< bytes of each write that leave within the call
  std::optional<std::size_t> faulty;  ///< this call of the wire fails, counted from 0
  error_code write_error;             ///< of every write
  error_code shut_down_error;         ///< of shut_down_sending()
  error_code close_error;             ///< of close()

  // What it sees:
  std::string received;        ///< all that was written
  std::size_t calls = 0;       ///< of the wire
  std::size_t writes = 0;      ///< of them
  std::size_t late_calls = 0;  ///< of them, after close()
  bool is_shut = false;
  bool is_closed = false;

  /// The session reads these bytes, in as many reads as it takes.
  void send(std::string_view bytes) {
    inbox_ += bytes;
    feed();
  }
  /// Its next read, also one that waits, fails.
  void hang_up(error_code how = boost::asio::error::eof) {
    end_ = how;
    feed();
  }
  void let_go() {
    holds_writes = false;
    finish_write();
  }
  [[nodiscard]] bool is_writing() const { return !write_.empty(); }

 private:
  friend class MemoryWire;

  bool begin_call() {
    if (is_closed) ++late_calls;
    return faulty == calls++;
  }
  void answer(Wire::Handler& handler, error_code error, std::size_t size) {
    boost::asio::post(executor_, [done = std::exchange(handler, {}), error, size] { done(error, size); });
  }
  void feed() {
    if (!read_) return;
    const std::size_t size = std::min(into_.size(), inbox_.size());
    if (size == 0 && !end_) return;
    std::copy_n(inbox_.begin(), size, into_.begin());
    inbox_.erase(0, size);
    answer(read_, size == 0 ? end_ : error_code{}, size);
  }
  void finish_write() {
    if (!write_) return;
    std::size_t size = 0;
    for (const Line& line : lines_) {
      const std::size_t gone = std::min(skipped_, line->size());
      skipped_ -= gone;
      received += line->substr(gone);
      size += line->size() - gone;
    }
    answer(write_, {}, size);
  }

  boost::asio::any_io_executor executor_;
  std::string inbox_;
  error_code end_;
  std::span<char> into_;
  Wire::Handler read_;
  std::span<const Line> lines_;
  std::size_t skipped_ = 0;
  Wire::Handler write_;
};

class MemoryWire final : public Wire {
 public:
  explicit MemoryWire(std::shared_ptr<FarEnd> far) : far_(std::move(far)) {}

  void read_some(std::span<char> into, Handler handler) override {
    CHECK(far_->read_.empty());
    const bool fails = far_->begin_call();
    far_->into_ = into;
    far_->read_ = std::move(handler);
    if (fails) return far_->answer(far_->read_, boost::asio::error::connection_reset, 0);
    far_->feed();
  }

  /// As a kernel that has no room, unless the test says that there is.
  [[nodiscard]] std::size_t write_now(std::span<const Line> lines) override {
    CHECK(far_->write_.empty());
    CHECK_FALSE(far_->is_shut);
    CHECK_FALSE(lines.empty());
    std::size_t room = far_->takes_at_once;
    std::size_t taken = 0;
    for (const Line& line : lines) {
      const std::size_t size = std::min(room, line->size());
      far_->received += line->substr(0, size);
      room -= size;
      taken += size;
    }
    return taken;
  }

  void write(std::span<const Line> lines, std::size_t skipped, Handler handler) override {
    CHECK(far_->write_.empty());
    CHECK_FALSE(far_->is_shut);
    CHECK_FALSE(lines.empty());
    ++far_->writes;
    const bool fails = far_->begin_call();
    far_->lines_ = lines;
    far_->skipped_ = skipped;
    far_->write_ = std::move(handler);
    if (fails) return far_->answer(far_->write_, boost::asio::error::broken_pipe, 0);
    if (far_->write_error) return far_->answer(far_->write_, far_->write_error, 0);
    // Read only when it is done, as a kernel might.
    if (!far_->holds_writes) boost::asio::post(far_->executor_, [far = far_] { far->finish_write(); });
  }

  [[nodiscard]] boost::system::error_code shut_down_sending() override {
    if (far_->begin_call()) return boost::asio::error::not_connected;
    if (far_->shut_down_error) return far_->shut_down_error;
    far_->is_shut = true;
    return {};
  }

  [[nodiscard]] boost::system::error_code close() override {
    const bool fails = far_->begin_call();
    far_->is_closed = true;
    if (far_->read_) far_->answer(far_->read_, boost::asio::error::operation_aborted, 0);
    if (far_->write_) far_->answer(far_->write_, boost::asio::error::operation_aborted, 0);
    if (fails) return boost::asio::error::connection_reset;
    return far_->close_error;
  }

 private:
  std::shared_ptr<FarEnd> far_;
};

}  // namespace woodlouse::server
