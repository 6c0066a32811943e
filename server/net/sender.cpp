#include "server/net/sender.h"

#include <boost/asio/post.hpp>

#include <cassert>
#include <utility>

namespace woodlouse::server {

using boost::system::error_code;

void Sender::write_soon() {
  if (!writing_.empty() || std::exchange(will_write_, true)) return;
  boost::asio::post(lane_, [keep = owner_.keep(), this] {
    will_write_ = false;
    write();
  });
}

void Sender::write() {
  if (!writing_.empty() || is_stopped_) return;
  writing_ = outbox_.take(std::move(writing_));
  if (!writing_.empty()) {
    std::size_t bytes = 0;
    for (const Line& line : writing_.lines) bytes += line->size();
    const std::size_t written = wire_.write_now(writing_.lines);
    assert(written <= bytes);
    if (written < bytes)
      return wire_.write(writing_.lines, written,
                         [keep = owner_.keep(), this](const error_code& error, std::size_t rest) {
                           on_written(error, rest);
                         });
    count(bytes);
  }
  owner_.on_all_sent();
}

void Sender::on_written(const error_code& error, std::size_t) {
  std::size_t bytes = 0;
  for (const Line& line : writing_.lines) bytes += line->size();
  if (error) writing_.frames = bytes = 0;
  count(bytes);
  if (is_stopped_) return;
  if (error) return owner_.on_broken();
  write();
}

/// The batch has left.
void Sender::count(std::size_t bytes) {
  traffic_.frames_sent.fetch_add(writing_.frames, std::memory_order_relaxed);
  traffic_.bytes_sent.fetch_add(bytes, std::memory_order_relaxed);
  writing_.lines.clear();
  outbox_.written();
  if (bytes > 0) owner_.on_sent();
}

}  // namespace woodlouse::server
