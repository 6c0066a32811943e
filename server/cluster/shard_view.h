// A shard as one who follows its log has it: each room's game re-run as its lines come, each tick proven, and
// who may come back to which louse. From it the rooms go on when their host is gone. Or, for who only shows
// them, whose lines are whose, and re-run elsewhere. Pure. One thread.
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/claim.h"
#include "server/cluster/batch.h"
#include "server/cluster/log_writer.h"
#include "server/stream/map_shelf.h"
#include "shared/core/error.h"
#include "shared/follow/follower.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

class ShardView {
 public:
  /// Who re-runs the rooms in place of this.
  struct Reader {
    /// One of a recording's, without its newline. A header that is told again for who comes now comes once.
    std::function<void(const std::string& room, std::string_view line)> line;
    std::function<void(const std::string& room)> closed;
  };
  struct Room {
    std::string header;                          ///< the line, without its newline
    std::unique_ptr<follow::Follower> follower;  ///< null: a reader has it
    std::map<match::PlayerId, Claim> claims;
    bool stands_still = false;  ///< before a batch that is gone: it goes on from its next keyframe
  };
  using Rooms = std::map<std::string, Room, std::less<>>;

  ShardView() = default;
  /// Nothing is re-run here.
  explicit ShardView(Reader reader) : reader_(std::move(reader)) { assert(reader_->line && reader_->closed); }

  /// Where one who knows nothing begins to read, by the last batch: every room's header and keyframe are in
  /// what follows. `headers`: of batches before it rooms whose headers are wanted first.
  using RoomNames = std::set<std::string, std::less<>>;
  struct Beginning {
    std::uint64_t from = 0;
    std::map<std::uint64_t, RoomNames> headers;
  };
  static Beginning beginning(const LastBatch& last);
  /// The headers of those rooms in a whole batch; nothing more of it is looked at. Errors: one is missing.
  core::Expected<void> take_headers(const RoomNames& rooms, std::string_view lines, const std::string& place);

  /// The stream's next batch. Errors: it can't follow what was read so far, or its lines are none of a log:
  /// what is known is worth nothing any more.
  core::Expected<void> take(std::uint64_t sequence, const Batch& batch);

  /// The next one is no batch, or is nobody's who may write: what was read so far holds on.
  void pass_over(std::uint64_t sequence) {
    assert(sequence == sequence_ + 1);
    sequence_ = sequence;
  }
  /// The next one was the log's, and is gone: the rooms stay at the tick before it up to their next
  /// keyframes.
  void lose(std::uint64_t sequence);
  /// Whether a room waits for its keyframe behind a batch that is gone.
  [[nodiscard]] bool has_gap() const;
  /// Whether the newest batch names a room that is not known here.
  [[nodiscard]] bool lacks_rooms() const;
  /// Whether the batch may stand there. Errors: it follows nothing that was read.
  [[nodiscard]] core::Expected<void> check_order(std::uint64_t sequence, const BatchHead& head) const;
  /// Of the batch taken last; 0: none.
  [[nodiscard]] std::uint64_t sequence() const { return sequence_; }
  [[nodiscard]] const std::optional<BatchHead>& head() const { return head_; }
  [[nodiscard]] const Rooms& rooms() const { return rooms_; }
  /// Where a room's re-run was another one than its lines tell, the first time; empty: nowhere.
  [[nodiscard]] const std::string& difference() const { return difference_; }
  /// Ticks that were re-run and gave the hash of the log.
  [[nodiscard]] std::uint64_t proven() const;

 private:
  core::Expected<void> take_line(const BatchLine& line);
  void record(const std::string& name, Room& room, std::string_view line);
  void pass_on(const std::string& name, Room& room, std::string_view line);

  std::optional<Reader> reader_;
  std::unique_ptr<MapShelf> maps_ = std::make_unique<MapShelf>();  ///< outlives the rooms
  Rooms rooms_;
  std::optional<BatchHead> head_;
  std::uint64_t sequence_ = 0;
  std::string difference_;
  WholeBatches whole_;
  bool is_behind_gap_ = false;  ///< the batch before the next one is gone
  std::string current_;         ///< the room whose lines follow; empty: none's so far
};

/// Calls visit(line) for each, without its newline, until it returns an error.
template <typename Visit>
core::Expected<void> for_each_line(std::string_view lines, const Visit& visit) {
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    if (auto visited = visit(lines.substr(0, end)); !visited) return visited;
    if (end == std::string_view::npos) break;
    lines.remove_prefix(end + 1);
  }
  return {};
}

}  // namespace woodlouse::server
