#include "shared/core/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "shared/core/joined.h"

namespace woodlouse::core {
namespace {

namespace fs = std::filesystem;

constexpr int kReading = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

tl::unexpected<Error> no_such_file(const fs::path& file) {
  return fail(file.string(), "no such file", "check the path, and the folder it starts from");
}

/// Whether it is a file that has an end.
Expected<void> check_kind(mode_t mode, const fs::path& file) {
  if (S_ISDIR(mode)) return fail(file.string(), "is a folder, not a file");
  if (!S_ISREG(mode))
    return fail(file.string(), "is no regular file", "pipes, devices and sockets are not read");
  return {};
}

/// Beforehand, too: what is opened notices it, be it a device or who waits at the other end of a pipe.
Expected<void> check_named(int folder, const char* name, int flags, const fs::path& file) {
  struct stat status {};
  if (::fstatat(folder, name, &status, flags) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return no_such_file(file);
    return fail(file.string(), joined({"can't be opened: ", std::strerror(errno)}));
  }
  return check_kind(status.st_mode, file);
}

}  // namespace

Expected<InputFile> InputFile::checked(int descriptor, const fs::path& path) {
  if (descriptor < 0) return fail(path.string(), joined({"can't be opened: ", std::strerror(errno)}));
  InputFile file(descriptor, path);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    return fail(path.string(), joined({"can't be examined: ", std::strerror(errno)}));
  if (auto kind = check_kind(status.st_mode, path); !kind) return tl::unexpected(kind.error());
  file.size_ = static_cast<std::size_t>(status.st_size);
  return file;
}

Expected<InputFile> InputFile::open(const fs::path& file) {
  if (auto named = check_named(AT_FDCWD, file.c_str(), 0, file); !named) return tl::unexpected(named.error());
  return checked(::open(file.c_str(), kReading), file);
}

Expected<InputFile> InputFile::open_within(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path base = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error) return fail(folder.string(), joined({"can't be opened: ", error.message()}));
  const fs::path real = fs::canonical(file, error);
  if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory)
    return no_such_file(file);
  if (error) return fail(file.string(), joined({"can't be opened: ", error.message()}));
  const auto [base_end, below] = std::mismatch(base.begin(), base.end(), real.begin(), real.end());
  if (base_end != base.end())
    return fail(file.string(), "leads out of its folder", "put the file itself there, not a link");
  if (below == real.end()) return fail(file.string(), "is a folder, not a file");

  // Neither `real` nor what is walked here has links, unless somebody makes one meanwhile: that ends the
  // walk.
  int at = ::open(base.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  auto part = below;
  for (auto next = std::next(part); at >= 0 && next != real.end(); part = next++) {
    const int inner = ::openat(at, part->c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    ::close(std::exchange(at, inner));
  }
  if (at < 0) return fail(file.string(), joined({"can't be opened: ", std::strerror(errno)}));
  auto named = check_named(at, part->c_str(), AT_SYMLINK_NOFOLLOW, file);
  const int descriptor = named ? ::openat(at, part->c_str(), kReading | O_NOFOLLOW) : -1;
  const int reason = errno;
  ::close(at);
  if (!named) return tl::unexpected(named.error());
  errno = reason;
  return checked(descriptor, file);
}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(other.release()), path_(std::move(other.path_)), size_(other.size_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  std::swap(size_, other.size_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int InputFile::release() { return std::exchange(descriptor_, -1); }

Expected<std::string> InputFile::read_all(std::size_t max_bytes) const {
  assert(descriptor_ >= 0);
  // Read rather than trust a size: it may grow, and files of /proc have none.
  std::string bytes;
  constexpr std::size_t kChunk = 1u << 16;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kChunk);
    const ssize_t got = ::read(descriptor_, bytes.data() + before, kChunk);
    if (got < 0 && errno != EINTR)
      return fail(path_.string(), joined({"can't be read to its end: ", std::strerror(errno)}));
    bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return bytes;
    if (bytes.size() > max_bytes)
      return fail(path_.string(), joined({"longer than ", std::to_string(max_bytes >> 20), " MiB"}));
  }
}

bool InputFile::read_at(std::span<std::byte> bytes, std::size_t offset) const {
  assert(descriptor_ >= 0);
  while (!bytes.empty()) {
    const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace woodlouse::core
