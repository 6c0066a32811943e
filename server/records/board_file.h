// A course's boards in a file: a header, then a row a line, each behind the ones before it and on the disk
// before the next. What a kill leaves is whole but for the last line, which is cut off when the file is
// opened again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/records/course.h"
#include "shared/core/error.h"
#include "shared/protocol/records.h"

namespace woodlouse::server {

/// A row as a file has it.
struct FileRow {
  protocol::GhostLine ghost;
  std::string text;      ///< its line, newline included
  std::size_t line = 0;  ///< of the file, from 1
};

struct ReadBoard {
  BoardHeader header;
  std::vector<FileRow> rows;
  std::vector<core::Error> faults;  ///< lines that are no rows, which are passed over
  std::size_t bytes = 0;            ///< of whole lines
  std::size_t torn = 0;             ///< of a last line that has no end
};

/// "00f31d1e9c0a8b77.ndjson"
std::filesystem::path board_file_name(std::uint64_t key);
/// All of a folder, by name. Errors: the folder can't be read.
core::Expected<std::vector<std::filesystem::path>> board_files(const std::filesystem::path& folder);
/// Errors: it can't be read, is no board, or of a later version.
core::Expected<ReadBoard> read_board(const std::filesystem::path& file);

/// One that is written to, by nobody else meanwhile. One thread at a time. A call that fails leaves whole
/// lines behind and may be tried again.
class BoardFile {
 public:
  struct Opened {
    std::unique_ptr<BoardFile> file;
    ReadBoard board;  ///< of a new one: its header alone; its torn bytes are cut off
  };
  /// Opens or creates it. Errors: somebody else writes to it, it can't be read or written, it is no board or
  /// one of another course.
  static core::Expected<Opened> open(const std::filesystem::path& file, const BoardHeader& header);
  BoardFile(const BoardFile&) = delete;
  BoardFile& operator=(const BoardFile&) = delete;
  ~BoardFile();

  /// One more row; on the disk when this returns. Errors: what the system says, or that the file is no longer
  /// the one that was opened: then replace() it.
  core::Expected<void> append(std::string_view line);
  /// These rows in place of all: what fails or is killed leaves the file as it was.
  core::Expected<void> replace(const std::vector<std::string_view>& lines);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  BoardFile(int descriptor, std::filesystem::path path, std::string header)
      : descriptor_(descriptor), path_(std::move(path)), header_(std::move(header)) {}
  [[nodiscard]] bool is_still_there() const;

  int descriptor_;
  std::filesystem::path path_;
  std::string header_;  ///< its first line
  std::size_t size_ = 0;
};

}  // namespace woodlouse::server
