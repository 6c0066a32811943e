#include "shared/core/sink_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace woodlouse::core {
namespace {

namespace fs = std::filesystem;

class FileSink final : public ByteSink {
 public:
  /// A pipe's descriptor does not wait (O_NONBLOCK).
  FileSink(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {
    assert(descriptor >= 0);
  }
  ~FileSink() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  Expected<void> write(std::string_view bytes) override {
    assert(descriptor_ >= 0);
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) {
        if (!takes_more()) return fail(name_, "nobody reads it");
        continue;
      }
      if (count < 0) return fail(name_, std::strerror(errno));
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return {};
  }
  Expected<void> close() override {
    assert(descriptor_ >= 0);
    if (::close(std::exchange(descriptor_, -1)) != 0) return fail(name_, std::strerror(errno));
    return {};
  }

 private:
  static constexpr int kPatience = 500;  // [ms]

  /// Whether a full pipe is read from, while whoever writes waits.
  [[nodiscard]] bool takes_more() const {
    pollfd pipe{descriptor_, POLLOUT, 0};
    return ::poll(&pipe, 1, kPatience) != 0;  // what else may be wrong with it, write() tells
  }

  int descriptor_;
  std::string name_;
};

/// -1: see errno. One that is there is opened only if it is no file: EEXIST otherwise.
int open_for_writing(const fs::path& file) {
  constexpr mode_t kMode = 0666;  // less the umask
  std::error_code error;
  const bool is_other = fs::is_other(file, error);
  // Not waiting: a pipe that nobody reads is an error, not a server that stands still.
  const int flags = O_WRONLY | O_CLOEXEC | (is_other ? O_NONBLOCK : O_CREAT | O_EXCL);
  return ::open(file.c_str(), flags, kMode);
}

/// Why `name`, the number-th for this file, can't be created: by errno.
tl::unexpected<Error> not_created(const fs::path& name, std::size_t number) {
  const char* const hint = errno == ENXIO          ? "a pipe needs somebody who reads it, before"
                           : errno != ENAMETOOLONG ? ""
                           : number == 0           ? "take a shorter one"
                                         : "there is one without a number, and this is too long: take a "
                                           "shorter one";
  return fail(name.string(), std::strerror(errno), hint);
}

}  // namespace

fs::path numbered(const fs::path& file, std::size_t number) {
  fs::path stem = file.filename();
  std::string extension;
  if (stem.extension() == ".zst") {
    extension = stem.extension().string();
    stem = stem.stem();
  }
  extension.insert(0, stem.extension().string());
  return fs::path(file).replace_filename(stem.stem().string() + '.' + std::to_string(number) + extension);
}

Expected<NewFile> create_file(const fs::path& file) {
  if (std::error_code error; fs::is_directory(file, error))
    return fail(file.string(), std::strerror(EISDIR), "name a file in it");
  for (std::size_t number = 0; number <= kMaxFileNumber; ++number) {
    fs::path name = number == 0 ? file : numbered(file, number);
    const int descriptor = open_for_writing(name);
    if (descriptor >= 0) {
      ::flock(descriptor, LOCK_EX | LOCK_NB);  // for is_being_written(); where none can be had, it says no
      auto sink = std::make_unique<FileSink>(descriptor, name.string());
      return NewFile{std::move(sink), std::move(name), number > 0};
    }
    if (errno != EEXIST) return not_created(name, number);
  }
  return fail(file.string(), "is there, and so is every numbered one of it");
}

bool is_being_written(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool is_locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return is_locked;
}

}  // namespace woodlouse::core
