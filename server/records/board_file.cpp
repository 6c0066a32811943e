#include "server/records/board_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "server/records/ghost_line.h"
#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/core/whole_file.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
constexpr mode_t kMode = 0666;  // less the umask

tl::unexpected<core::Error> failed(const fs::path& file, int error) {
  return core::fail(file.string(), std::strerror(error));
}

/// All or the error.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// That a file is called so.
void sync_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// Of a file's whole lines.
core::Expected<ReadBoard> read_lines(const std::string& text, const std::string& name) {
  ReadBoard board;
  std::size_t line = 0;
  while (board.bytes < text.size()) {
    const std::size_t end = text.find('\n', board.bytes);
    if (end == std::string::npos) break;
    const std::string_view whole = std::string_view(text).substr(board.bytes, end + 1 - board.bytes);
    board.bytes = end + 1;
    ++line;
    if (line == 1) {
      auto header = read_header_line(whole.substr(0, whole.size() - 1), name);
      if (!header) return tl::unexpected(header.error());
      board.header = std::move(*header);
      continue;
    }
    auto ghost = read_ghost_line(whole, core::joined({name, ":", std::to_string(line)}));
    if (ghost)
      board.rows.push_back({std::move(*ghost), std::string(whole), line});
    else
      board.faults.push_back(ghost.error());
  }
  board.torn = text.size() - board.bytes;
  return board;
}

}  // namespace

fs::path board_file_name(std::uint64_t key) { return core::to_hex(key) + ".ndjson"; }

core::Expected<std::vector<fs::path>> board_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".ndjson") files.push_back(at->path());
  if (error) return core::fail(folder.string(), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

core::Expected<ReadBoard> read_board(const fs::path& file) {
  const auto text = core::read_whole_file(file, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  auto board = read_lines(*text, file.string());
  if (board && board->bytes == 0) return core::fail(file.string(), "has no whole line");
  return board;
}

BoardFile::~BoardFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

core::Expected<BoardFile::Opened> BoardFile::open(const fs::path& path, const BoardHeader& header) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, kMode);
  if (descriptor < 0) return failed(path, errno);
  Opened opened;
  opened.file.reset(new BoardFile(descriptor, path, header_line(header)));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return core::fail(path.string(),
                      errno == EWOULDBLOCK ? "another server writes to it" : std::strerror(errno),
                      "a board has one writer: stop that one, or name another folder");
  const auto text = core::read_whole_file(path, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  auto board = read_lines(*text, path.string());
  if (!board) return tl::unexpected(board.error());
  opened.board = std::move(*board);
  BoardFile& file = *opened.file;
  file.size_ = opened.board.bytes;
  if (opened.board.torn != 0 && ::ftruncate(descriptor, static_cast<off_t>(file.size_)) != 0)
    return failed(path, errno);
  if (file.size_ != 0) {
    if (opened.board.header.key == header.key) return opened;
    return core::fail(path.string(), "is the board of another course, whatever it is called");
  }
  opened.board.header = header;
  if (const auto begun = file.append(file.header_); !begun) return tl::unexpected(begun.error());
  sync_folder(path);
  return opened;
}

bool BoardFile::is_still_there() const {
  struct stat named {};
  struct stat opened {};
  return ::stat(path_.c_str(), &named) == 0 && ::fstat(descriptor_, &opened) == 0 &&
         named.st_dev == opened.st_dev && named.st_ino == opened.st_ino &&
         static_cast<std::size_t>(opened.st_size) == size_;
}

core::Expected<void> BoardFile::append(std::string_view line) {
  if (!is_still_there()) return core::fail(path_.string(), "is no longer the file that was opened");
  int error = write_all(descriptor_, line);
  if (error == 0 && ::fsync(descriptor_) != 0) error = errno;
  if (error == 0) {
    size_ += line.size();
    return {};
  }
  // A half line must not stand before the next one. Where it does, is_still_there() says no.
  static_cast<void>(::ftruncate(descriptor_, static_cast<off_t>(size_)));
  return failed(path_, error);
}

core::Expected<void> BoardFile::replace(const std::vector<std::string_view>& lines) {
  const fs::path fresh = fs::path(path_) += ".tmp";
  const int descriptor =
      ::open(fresh.c_str(), O_RDWR | O_APPEND | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK, kMode);
  if (descriptor < 0) return failed(fresh, errno);
  std::string text = header_;
  for (const std::string_view line : lines) text += line;
  ::flock(descriptor, LOCK_EX | LOCK_NB);
  int error = write_all(descriptor, text);
  if (error == 0 && ::fsync(descriptor) != 0) error = errno;
  if (error == 0 && ::rename(fresh.c_str(), path_.c_str()) != 0) error = errno;
  if (error != 0) {
    ::close(descriptor);
    ::unlink(fresh.c_str());
    return failed(fresh, error);
  }
  sync_folder(path_);
  ::close(std::exchange(descriptor_, descriptor));
  size_ = text.size();
  return {};
}

}  // namespace woodlouse::server
