#include "server/records/board_rows.h"

#include <algorithm>
#include <utility>

namespace woodlouse::server {

std::uint32_t BoardRows::take(Row row) {
  std::vector<Row>& board = boards_[static_cast<std::size_t>(row.run.board)];
  const auto same = std::find_if(board.begin(), board.end(), [&row](const Row& other) {
    return other.run.name == row.run.name && other.run.role == row.run.role;
  });
  if (same != board.end()) {
    if (same->run.time <= row.run.time) return 0;
    board.erase(same);
  }
  // Of two as good the one that was there first.
  const auto place =
      std::upper_bound(board.begin(), board.end(), row.run.time,
                       [](std::uint64_t time, const Row& other) { return time < other.run.time; });
  const auto rank = static_cast<std::size_t>(place - board.begin()) + 1;
  if (rank > kMost) return 0;
  board.insert(place, std::move(row));
  if (board.size() > kMost) board.pop_back();
  return static_cast<std::uint32_t>(rank);
}

bool BoardRows::wants(protocol::Board board, std::uint64_t time) const {
  const std::vector<Row>& rows = of(board);
  return rows.size() < kMost || time < rows.back().run.time;
}

std::size_t BoardRows::count() const {
  std::size_t count = 0;
  for (const auto& board : boards_) count += board.size();
  return count;
}

void BoardRows::cut(std::size_t most) {
  for (auto& board : boards_)
    if (board.size() > most) board.erase(board.begin() + static_cast<std::ptrdiff_t>(most), board.end());
}

std::size_t BoardRows::bytes() const {
  std::size_t bytes = 0;
  for_each([&bytes](const Row& row) { bytes += row.line->size(); });
  return bytes;
}

}  // namespace woodlouse::server
