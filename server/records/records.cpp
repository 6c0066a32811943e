#include "server/records/records.h"

#include <system_error>
#include <utility>

#include "server/records/course.h"

namespace woodlouse::server {

core::Expected<std::unique_ptr<GhostRecorder>> Records::open(const std::string& room,
                                                             const match::Match& match,
                                                             const std::string& map_file) {
  const std::uint32_t tick_hz = match.settings().tick_hz;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    return core::fail("--records " + folder_.string(), error.message(), "a folder that may be written to");
  std::shared_ptr<Board>& board = boards_[course_key(match.map(), tick_hz, match::kBehavior)];
  if (board == nullptr) {
    auto opened = Board::open(folder_, match.shared_map(), tick_hz, map_file, log_);
    if (!opened)
      return core::fail("cannot write records to " + opened.error().where, opened.error().what,
                        opened.error().hint);
    board = std::move(*opened);
  }
  return std::make_unique<GhostRecorder>(room, tick_hz, board, log_);
}

void Records::end(Time latest) {
  for (const auto& [key, board] : boards_)
    if (board != nullptr) board->close();
  for (const auto& [key, board] : boards_)
    if (board != nullptr) board->end(latest);
}

std::vector<std::string> Records::lost() const {
  std::vector<std::string> lost;
  for (const auto& [key, board] : boards_) {
    if (board == nullptr) continue;
    for (std::string& one : board->lost()) lost.push_back(std::move(one));
  }
  return lost;
}

}  // namespace woodlouse::server
