// What a shard's log is made of: batches, each a few hundred milliseconds of its rooms, packed. The text of
// one:
//
//     {"batch":n,"epoch":e,"host":"b","nonce":"..","behavior":10,"rooms":[{"room":"hill","header":s,"keyframe":s,"tick":t}]}
//     {"room":"hill"}                                      whose the lines below are
//     {"step":..}                                          a recording's own lines (docs/determinism.md),
//     byte for byte
//     {"claim":3,"name":"ann","role":"player","token":".."}   who may come back to which louse, and,
//     "muted_until", is muted
//     {"closed":"hill"}                                    that room is no more
//
// One that is longer than a message of NATS may be goes in parts, each with a head of its own, "part" and
// "parts" in it, and the next of the batch's numbers; what follows the head is a piece of the text. It is
// read once all are there: up to then the heads name the rooms' places as they were before.
//
// The first line says whose batch it is, and where in the stream one that begins here finds each room's last
// header and keyframe. Pure. Everything read here came from outside and is checked here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/access/claim.h"
#include "server/cluster/cluster_settings.h"
#include "shared/core/error.h"
#include "shared/match/match.h"

namespace woodlouse::server {

/// Who writes a log, from one taking over on. The nonce tells two apart that count the same epoch.
struct Writer {
  std::uint64_t epoch = 0;
  std::string host;
  std::array<std::uint64_t, 2> nonce{};
  friend bool operator==(const Writer&, const Writer&) = default;
};

/// "epoch 3 of b".
inline std::string to_text(const Writer& writer) {
  return "epoch " + std::to_string(writer.epoch) + " of " + writer.host;
}

/// Where in the stream a room's newest lines of a kind are, by the sequence number of their batch; 0: in
/// none.
struct RoomPlace {
  std::string room;
  std::uint64_t header = 0;
  std::uint64_t keyframe = 0;
  std::uint64_t tick = 0;  ///< that the batch leads to
  friend bool operator==(const RoomPlace&, const RoomPlace&) = default;
};

/// A batch's first line.
struct BatchHead {
  Writer writer;
  std::uint64_t number = 0;  ///< of the epoch's batches, from 0: the one that takes the log
  int behavior = match::kBehavior;
  std::vector<RoomPlace> rooms;
  std::uint32_t part = 0, parts = 1;  ///< part < parts <= kMostParts
  friend bool operator==(const BatchHead&, const BatchHead&) = default;
};

struct Batch {
  BatchHead head;
  std::string lines;  ///< behind the head, each with its newline; of parts but the last any piece of them
};

/// What a message of NATS may be, 1 MB by default, less its own head.
inline constexpr std::size_t kMostMessageBytes = 1'000'000;
/// Of lines, packed or not: the packed ones, with a head, are no longer than a message may be.
inline constexpr std::size_t kPartBytes = 800'000;
inline constexpr std::uint32_t kMostParts = 80;

inline constexpr std::size_t kMostHostBytes = 64;
/// Of epochs, batches and ticks: one more always fits.
inline constexpr std::uint64_t kMostCount = std::uint64_t{1} << 62;
inline constexpr std::size_t kMostRoomBytes = 128;

/// Of head and lines. REQUIRES whole lines, or a part of some.
std::string pack(const BatchHead& head, std::string_view lines);
/// Of lines in one message, however short they pack: who unpacks them takes no more than twice that.
inline constexpr std::size_t kMostWholeBytes = std::size_t{16} << 20;
/// The messages that a batch goes in, numbered from head.number on: one, or its parts. before: the rooms'
/// places as of the batch before. Empty: it is too long. REQUIRES whole lines.
std::vector<std::string> pack_in_parts(const BatchHead& head, const std::vector<RoomPlace>& before,
                                       std::string_view lines);
/// Errors: it is no batch, or too long; of another behavior, where who reads it could follow none of it.
/// place: for errors.
core::Expected<Batch> unpack(std::string_view packed, const std::string& place);

/// Makes batches of their parts, in the stream's order. One thread.
class WholeBatches {
 public:
  /// The lines of the batch that ends with this message, valid till the next one is taken; nothing: parts are
  /// still to come, or those before this one did not.
  [[nodiscard]] std::optional<std::string_view> take(const Batch& batch);
  /// A message is gone: what it was a part of is never whole.
  void lose() { next_ = 0; }

 private:
  BatchHead last_;
  std::uint32_t next_ = 0;  ///< the part that is awaited; 0: none
  std::string lines_;
};

// Those lines of a batch that no recording has; each appended with its newline.

void append_room(std::string& out, std::string_view room);
void append_claim(std::string& out, const Claim& claim);
void append_closed(std::string& out, std::string_view room);

struct RoomLine {
  std::string room;
};
struct ClosedLine {
  std::string room;
};
/// A recording's own; without its newline, as long as the batch.
struct RecordedLine {
  std::string_view text;
};
using BatchLine = std::variant<RoomLine, ClosedLine, Claim, RecordedLine>;

/// One line, without its newline. Errors: a line of the log's own that is not as it should be.
core::Expected<BatchLine> read_batch_line(std::string_view line, const std::string& place);

}  // namespace woodlouse::server
