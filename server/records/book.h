// What a board's thread works on: the rows, their file, and what is shown of them. It outlives its board
// where the thread stands in a write.
#pragma once

#include <spdlog/logger.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/logging/events.h"
#include "server/records/board.h"

namespace woodlouse::server {

class Board::Book {
 public:
  Book(std::shared_ptr<const map::Map> map, std::uint32_t tick_hz, BoardFile::Opened opened,
       std::shared_ptr<spdlog::logger> log);

  // ---- any thread; none waits for the disk ---------------------------------------------------------------

  struct Shown {
    struct Of {
      Line records;
      std::vector<Line> ghosts;  ///< by rank
      std::uint64_t worst = 0;   ///< time of the last, of a full board; else 0
    };
    std::array<Of, protocol::kBoards.size()> boards;
    [[nodiscard]] const Of& of(protocol::Board board) const {
      return boards[static_cast<std::size_t>(board)];
    }
  };
  [[nodiscard]] std::shared_ptr<const Shown> shown() const;
  void say(LogEvent event, const std::string& text);
  /// One more run comes, or does not after all.
  void expect(bool comes) { comes ? ++expected_ : --expected_; }
  /// Neither log nor rooms are touched again.
  void leave_behind();
  [[nodiscard]] std::vector<std::string> lost() const;

  // ---- its thread
  // ------------------------------------------------------------------------------------------

  /// Takes the rows of the file.
  void begin();
  void take(const LiveRun& run);
  /// What could not be written.
  void try_again();

 private:
  void show();
  void write(const protocol::RecordRun& run, Line line);
  void write_anew();
  void note(const core::Expected<void>& outcome);
  void tell(const LiveRun& run);

  const std::shared_ptr<const map::Map> map_;
  const std::uint32_t tick_hz_;
  const std::string name_;

  std::atomic<std::size_t> expected_{0};  ///< runs that are not taken or refused yet
  std::atomic<bool> is_left_{false};
  mutable std::mutex outside_;  ///< held while somebody is told, who never waits, and for what is shown
  std::shared_ptr<spdlog::logger> log_;  ///< null: left behind
  std::shared_ptr<const Shown> shown_;
  std::vector<std::string> unwritten_names_;
  bool is_cut_off_ = false;

  // The thread's:
  std::unique_ptr<BoardFile> file_;
  std::vector<FileRow> of_file_;  ///< until begin()
  BoardRows rows_;
  std::vector<Line> unwritten_;
  bool has_strange_lines_ = false;  ///< the file has some that are on no board: it is not rewritten
  bool is_failing_ = false;
  Time told_at_{};
};

}  // namespace woodlouse::server
