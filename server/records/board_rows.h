// The rows of a course's boards in memory, best first. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "server/frames/line.h"
#include "shared/protocol/records.h"

namespace woodlouse::server {

struct Row {
  protocol::RecordRun run;
  Line line;  ///< the whole of it, as a file has it and who asks for its ghost gets it
};

/// A better run takes the place of the older one of that name and role: names are no proof of who drove, and
/// a board of one name's runs would be of no use.
class BoardRows {
 public:
  static constexpr std::size_t kMost = protocol::kMostRank;  ///< of each board

  /// Its rank from 1; 0, and it is not in: there is a better one of the name, or kMost are.
  std::uint32_t take(Row row);
  /// Whether one of that time may be in.
  [[nodiscard]] bool wants(protocol::Board board, std::uint64_t time) const;
  [[nodiscard]] const std::vector<Row>& of(protocol::Board board) const {
    return boards_[static_cast<std::size_t>(board)];
  }
  [[nodiscard]] std::size_t count() const;
  /// Those behind the first `most` of each board go.
  void cut(std::size_t most);
  /// Bytes of all lines.
  [[nodiscard]] std::size_t bytes() const;
  void for_each(const std::function<void(const Row&)>& visit) const {
    for (const auto& board : boards_)
      for (const Row& row : board) visit(row);
  }

 private:
  std::array<std::vector<Row>, protocol::kBoards.size()> boards_;
};

}  // namespace woodlouse::server
