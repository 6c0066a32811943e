// One writer's side of a shard's log: what is published next, behind which sequence number, and what an
// answer, or none, means. The log is the lease: each batch expects exactly its predecessor, so that of two
// who write one is refused. Pure: whoever owns it sends what it says and tells it what came back; times are
// arguments.
//
//   taking --its first batch is stored--> writing --another's stands there--> fenced
//      `-----another's stands there--> lost   ^--an error, no answer--> asking
//
// Identity is the whole Writer, never the epoch's number alone: whose acknowledgement was lost must not take
// another's epoch of the same number for his own. What is stored is told by the number in the last batch,
// never by counting sequence numbers. A read that shows less than was acknowledged may be an old one: what it
// says counts only once a publish that expects it is accepted.
//
// One batch is on its way at a time. Were a second one sent ahead, expecting the first one's sequence number,
// another host's batch could be stored at that very number: the first would be refused, and the second
// accepted behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "server/cluster/batch.h"
#include "server/timing/clock.h"

namespace woodlouse::server {

/// Of a stream's last message.
struct LastBatch {
  std::uint64_t sequence = 0;
  BatchHead head;
};

class LogWriter {
 public:
  /// Acknowledged ones, for a stream that has gone back after a loss of power: two minutes of them.
  static constexpr std::size_t kMostKept = 1200;
  /// Of all batches; of acknowledged ones fewer are kept then.
  static constexpr std::size_t kMostBytes = std::size_t{128} << 20;
  static constexpr Duration kAnswerWithin = std::chrono::milliseconds(500);
  /// So many reads in a row that show nothing of this epoch.
  static constexpr int kBelievedAfter = 20;
  /// Between two reads of the last batch.
  static constexpr Duration kAskEvery = std::chrono::milliseconds(50);

  enum class State : std::uint8_t {
    kTaking,  ///< the first batch is not stored yet
    kWriting,
    kLost,    ///< another one was first
    kFenced,  ///< another one has taken the log over
    kGone,  ///< the stream has gone back to before what is kept, or holds an older writer's late batch: only
            ///< another epoch can go on
  };

  /// after: the stream's last message; it takes the log behind it. Its epoch is above that one's.
  LogWriter(Writer writer, std::uint64_t after);

  /// The next batch's number, and its sequence number once it is stored.
  [[nodiscard]] std::uint64_t next_number() const { return first_ + batches_.size(); }
  [[nodiscard]] std::uint64_t next_sequence() const { return sequence_of(next_number()); }
  /// The next batch, packed. The first one takes the log.
  void add(std::string packed);

  struct Publish {
    std::shared_ptr<const std::string> bytes;
    std::uint64_t after = 0;  ///< the sequence number that it expects to be the last
  };
  /// What to publish now; nothing: wait. Each is given once, till an error makes it go again.
  std::optional<Publish> next(Time now);
  /// Whether the stream's last batch is to be read now, which stops the publishing.
  [[nodiscard]] bool is_to_ask(Time now);

  // What came back:

  void acknowledged(std::uint64_t sequence, Time now);
  /// A publish was refused, or it is not known what became of it.
  void failed() { is_asking_ = is_asking_ || is_open(); }
  /// What was read; nothing: it couldn't be, and is to be read again.
  void read(const std::optional<LastBatch>& last, Time now);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool is_open() const { return state_ == State::kTaking || state_ == State::kWriting; }
  [[nodiscard]] const Writer& writer() const { return writer_; }
  /// Who has the log, once it is lost or fenced.
  [[nodiscard]] const Writer& other() const { return other_; }
  /// Batches that are not acknowledged.
  [[nodiscard]] std::size_t waiting() const { return batches_.size() - (acked_ - first_); }
  /// Of all that are kept; more than kMostBytes: of those that are not acknowledged.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  /// Batches that are stored: those of lower numbers.
  [[nodiscard]] std::uint64_t acked() const { return acked_; }
  /// For how long none was acknowledged while some waited.
  [[nodiscard]] Duration silence(Time now) const {
    return waiting() == 0 || silent_since_ == Time{} ? Duration{} : now - silent_since_;
  }

 private:
  [[nodiscard]] std::uint64_t sequence_of(std::uint64_t number) const { return after_ + 1 + number; }
  void go_on_from(std::uint64_t number, Time now);
  void end(State state, const Writer& other);

  const Writer writer_;
  const std::uint64_t after_;  ///< the last sequence number before this epoch
  State state_ = State::kTaking;
  Writer other_;
  std::deque<std::shared_ptr<const std::string>> batches_;  ///< from first_ on
  std::size_t bytes_ = 0;                                   ///< of batches_
  std::uint64_t first_ = 0;                                 ///< number of batches_.front()
  std::uint64_t acked_ = 0;                                 ///< numbers below are stored
  std::uint64_t sent_ = 0;                                  ///< numbers below are published
  bool is_asking_ = false;
  int told_before_ = 0;  ///< how often in a row
  std::uint64_t before_ =
      0;  ///< the sequence number of a read that showed nothing of this epoch, the last one
  Time asked_at_ = Time::min();
  Time sent_at_{};       ///< when the oldest of those in flight was published, or the last answer came
  Time silent_since_{};  ///< Time{}: nothing has been published since all was acknowledged
};

}  // namespace woodlouse::server
