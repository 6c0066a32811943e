#include "server/watchers/recording_files.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <ctime>
#include <istream>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "shared/core/joined.h"
#include "shared/replay/format.h"
#include "shared/replay/source_file.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

}  // namespace

RecordingFiles::RecordingFiles(RecordPattern pattern, std::optional<std::uint64_t> keep)
    : pattern_(std::move(pattern)), keep_(keep) {}

fs::path RecordingFiles::file(const std::string& room) const {
  return pattern_.file(room, std::time(nullptr));
}

core::Expected<core::NewFile> RecordingFiles::create(const std::string& room) {
  const fs::path& folder = pattern_.folder();
  std::error_code error;
  // None is made: of a disk that is not mounted, or a slip, somebody is to hear.
  if (!folder.empty() && !fs::is_directory(folder, error))
    return core::fail(
        file(room).string(),
        error && error != std::errc::no_such_file_or_directory ? error.message() : "its folder is not there",
        core::joined({"make it:  mkdir -p ", folder.string()}));
  auto made = core::create_file(file(room));
  if (!made) return made;
  const std::lock_guard lock(mutex_);
  open_[made->path] = 0;
  return made;
}

void RecordingFiles::closed(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  const auto found = open_.find(file);
  if (found == open_.end()) return;
  open_.erase(found);
  finished_bytes_.reset();
  ++closings_;
}

bool RecordingFiles::is_open(const fs::path& file) const {
  const std::lock_guard lock(mutex_);
  return open_.contains(file);
}

std::uint64_t RecordingFiles::open_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [file, written] : open_) bytes += written;
  return bytes;
}

/// By its first line. What has none as yet may become one: it is asked again.
bool RecordingFiles::is_recording(const fs::path& file) {
  if (const auto known = known_.find(file); known != known_.end()) return known->second;
  const std::string begin = core::joined({R"({"format":")", replay::kFormat, "\""});
  const auto stream = replay::source_of_file(file).open();
  std::string read(begin.size(), '\0');
  if (!stream || !(*stream)->read(read.data(), static_cast<std::streamsize>(read.size()))) return false;
  return known_[file] = read == begin;
}

/// The oldest first.
std::vector<RecordingFiles::Finished> RecordingFiles::finished_ones() {
  std::vector<Finished> result;
  std::error_code error;
  const fs::path& folder = pattern_.folder();
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().filename();
    const fs::path path = folder / name;
    std::error_code gone;  // another room's may have gone meanwhile
    if (!pattern_.matches(name.string()) || entry->symlink_status(gone).type() != fs::file_type::regular)
      continue;
    Finished one{path, entry->last_write_time(gone), entry->file_size(gone)};
    if (!gone && !is_open(path) && is_recording(path)) result.push_back(std::move(one));
  }
  std::sort(result.begin(), result.end(), [](const Finished& a, const Finished& b) {
    return std::tie(a.written, a.path) < std::tie(b.written, b.path);
  });
  return result;
}

RecordingFiles::Removed RecordingFiles::make_room(const fs::path& file, std::uint64_t bytes) {
  Removed removed;
  if (!keep_) return removed;
  const auto is_enough = [this](std::uint64_t finished) {
    const std::lock_guard lock(mutex_);
    return finished + open_bytes() <= *keep_;
  };
  std::uint64_t closings = 0;
  {
    const std::lock_guard lock(mutex_);
    assert(open_.contains(file));
    open_[file] += bytes;
    if (finished_bytes_ && *finished_bytes_ + open_bytes() <= *keep_) return removed;
    closings = closings_;
  }
  const std::unique_lock looking(looking_, std::try_to_lock);
  if (!looking) return removed;  // another room makes room; what is too much is seen with the next bytes
  const std::vector<Finished> finished = finished_ones();
  std::uint64_t left = 0;
  for (const Finished& one : finished) left += one.bytes;
  bool fits = is_enough(left);
  for (auto one = finished.begin(); !fits && one != finished.end(); ++one) {
    std::error_code error;
    if (is_open(one->path) || core::is_being_written(one->path) || !fs::remove(one->path, error)) continue;
    known_.erase(one->path);
    ++removed_;
    ++removed.files;
    removed.bytes += one->bytes;
    removed.last = one->path.string();
    left -= one->bytes;
    fits = is_enough(left);
  }
  const std::lock_guard lock(mutex_);
  if (closings == closings_) finished_bytes_ = left;
  // Rooms that are too much together lose the one that is most of it.
  const auto largest = std::max_element(open_.begin(), open_.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  removed.fits = fits || largest->second > open_[file];
  return removed;
}

}  // namespace woodlouse::server
