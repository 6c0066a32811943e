// A connection to NATS, and what a cluster asks of it: a stream that is written with an expectation, read in
// order and by its last message; core subjects beside it. Alone includes nats.h (nats_link.cpp), Debian's
// libnats 3.4.
//
// Calls may block for as long as a timeout says, and for longer where a socket is full: no strand of the
// server makes one. What comes is told on threads of libnats.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/cluster/cluster_settings.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// What a subscription gives; any thread.
using NatsMessageTaken = std::function<void(std::string subject, std::string bytes, std::uint64_t sequence)>;

class NatsLink {
 public:
  /// Told on threads of libnats; whoever is told hands it on and returns.
  struct Told {
    std::function<void(std::uint64_t sequence)> acknowledged;
    std::function<void(std::string why)> refused;
    std::function<void(bool is_connected)> connected;
    std::function<void()> closed{};  ///< for good: it is to be opened anew
  };

  /// Waits for the first connection, at most a few seconds. purpose: in NATS' own list of connections.
  static core::Expected<std::unique_ptr<NatsLink>> open(const ClusterSettings& settings,
                                                        const std::string& purpose, Told told);
  NatsLink(const NatsLink&) = delete;
  NatsLink& operator=(const NatsLink&) = delete;
  virtual ~NatsLink() = default;

  // The log:

  /// Told of later. Error: it is not on its way.
  virtual core::Expected<void> append(std::string_view bytes, std::uint64_t after) = 0;
  struct Message {
    std::uint64_t sequence = 0;
    std::string bytes;
  };
  // One that the stream holds no more, as NATS finds it damaged, is a message without bytes.

  /// Errors: there is none, or nobody answers.
  virtual core::Expected<Message> last() = 0;
  /// Errors: nobody answers.
  virtual core::Expected<Message> read(std::uint64_t sequence) = 0;
  /// Each message from that one on, in order. One reader at a time; reading again ends the one before.
  virtual core::Expected<void> follow(std::uint64_t from, NatsMessageTaken taken) = 0;
  virtual void unfollow() = 0;
  /// Makes the stream with a first message, or leaves it as it is. True: it is new.
  virtual core::Expected<bool> make_stream(std::string_view first) = 0;
  struct StreamState {
    std::uint64_t first = 0, last = 0, messages = 0, bytes = 0;
    std::uint64_t replicas = 0, current = 0;  ///< how many of them have all
    std::string leader;
  };
  virtual core::Expected<StreamState> stream_state() = 0;

  // Core subjects:

  virtual core::Expected<void> publish(const std::string& subject, std::string_view bytes) = 0;
  virtual core::Expected<void> subscribe(const std::string& subject, NatsMessageTaken taken) = 0;

 protected:
  NatsLink() = default;
};

}  // namespace woodlouse::server
