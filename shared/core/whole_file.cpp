#include "shared/core/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "shared/core/input_file.h"

namespace woodlouse::core {

Expected<std::string> read_whole_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const auto input = InputFile::open(file);
  if (!input) return tl::unexpected(input.error());
  return input->read_all(max_bytes);
}

Expected<std::string> read_whole_file_within(const std::filesystem::path& folder,
                                             const std::filesystem::path& file, std::size_t max_bytes) {
  const auto input = InputFile::open_within(folder, file);
  if (!input) return tl::unexpected(input.error());
  return input->read_all(max_bytes);
}

Expected<void> replace_whole_file(const std::filesystem::path& file, std::string_view text) {
  assert(file.has_filename());
  std::string fresh = file.string() + ".XXXXXX";
  const auto failed = [&](int error) {
    return fail(file.string(), "can't be written: " + std::generic_category().message(error),
                "the file is as it was");
  };
  const int descriptor = ::mkostemp(fresh.data(), O_CLOEXEC);
  if (descriptor < 0) return failed(errno);
  int error = 0;
  struct stat before {};
  if (::stat(file.c_str(), &before) == 0 && ::fchmod(descriptor, before.st_mode & 0777u) != 0) error = errno;
  while (error == 0 && !text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno != EINTR) error = errno;
    if (written == 0) error = EIO;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(fresh.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return {};
  ::unlink(fresh.c_str());
  return failed(error);
}

}  // namespace woodlouse::core
