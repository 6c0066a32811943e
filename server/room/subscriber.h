// Who receives what a room says: a session, or a test's stand-in. The room knows nothing of sockets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "server/frames/frame.h"
#include "server/stream/stream_part.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Counts the connections of a server; never used again.
using SessionId = std::uint64_t;

/// Every call returns at once and may come from any thread; calls of one thread arrive in their order.
class Subscriber {
 public:
  virtual ~Subscriber() = default;

  /// Of the server's lanes (lanes.h), the one that it lives on; never changes. What is called there is done
  /// within the call.
  [[nodiscard]] virtual std::size_t lane() const = 0;

  /// An event or other lines that several share, one or more, whole.
  virtual void deliver(Line line) = 0;
  /// An answer to this one alone.
  virtual void answer(protocol::ServerMessage message) = 0;
  /// The next key or delta; may replace one that has not been sent.
  virtual void show(const Frame& frame) = 0;
  /// Frames asked for again, or the first ones; they say nothing about the client's pace.
  virtual void show_again(const Frame& frame) = 0;
  /// The next part of the stream, of who watches by inputs.
  virtual void follow(const StreamPart& part) {
    if (part.lines) deliver(part.lines);
  }
  /// The answer to get_map.
  virtual void deliver_map(Line line) = 0;
  /// The answer to list_records or get_ghost, which many share.
  virtual void deliver_record(Line line) { deliver(std::move(line)); }
  /// The room did not take the join; another may be tried.
  virtual void refuse_join(protocol::ErrorMessage error) = 0;
  /// The welcome, to each game of the room anew: frames that have not left yet are of the one before.
  /// `divisor`: the client takes every divisor-th frame.
  virtual void welcome(protocol::Welcome welcome, std::uint32_t divisor) = 0;
  /// Its `leave` is granted: all that it asked for before has been answered by the calls before this one.
  virtual void let_go() = 0;
  /// The room ends the connection with this bye.
  virtual void end(protocol::Bye bye) = 0;
};

}  // namespace woodlouse::server
