// A file opened for reading, which is sure to have an end and to keep nobody waiting.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::core {

/// A regular file, open; what it is was asked of the open file, not of a name that may meanwhile mean
/// another. Pipes, devices and sockets, which may keep whoever reads them waiting or never end, are refused.
/// Files that the system makes up (/proc) pass for regular ones: they are never waited for (O_NONBLOCK), and
/// whoever reads bounds what he takes. Errors: no such file, a folder, none of that kind, the system's words.
class InputFile {
 public:
  /// What the user of the program named: links are followed.
  static Expected<InputFile> open(const std::filesystem::path& file);
  /// What somebody else named, be it in a file that came from outside: `file` must lie in `folder` or below
  /// it, wherever links lead. Another error: it does not. The folder is taken as it is; empty: the present
  /// one.
  static Expected<InputFile> open_within(const std::filesystem::path& folder,
                                         const std::filesystem::path& file);

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// To whoever closes it.
  [[nodiscard]] int release();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// [bytes], when it was opened; 0 of what the system makes up.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// All of it, from where it stands. Errors: it can't be read, it is longer than max_bytes.
  [[nodiscard]] Expected<std::string> read_all(std::size_t max_bytes) const;
  /// Fills `bytes` from `offset` [bytes] on, wherever the file stands; false: not all could be read. Any
  /// thread.
  [[nodiscard]] bool read_at(std::span<std::byte> bytes, std::size_t offset) const;

 private:
  InputFile(int descriptor, std::filesystem::path path) : descriptor_(descriptor), path_(std::move(path)) {}
  /// Owns the descriptor; negative: errno says why there is none.
  static Expected<InputFile> checked(int descriptor, const std::filesystem::path& path);

  int descriptor_ = -1;
  std::filesystem::path path_;
  std::size_t size_ = 0;
};

}  // namespace woodlouse::core
