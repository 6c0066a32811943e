#include "client/play/modes/ghost_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

#include "client/play/modes/ghost_run.h"
#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/core/whole_file.h"
#include "shared/map/map_search_file.h"
#include "shared/match/ghost.h"
#include "shared/match/match.h"
#include "shared/protocol/ack_line.h"
#include "shared/protocol/codec.h"

namespace woodlouse::client {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 8u << 20;

fs::path file_of(const fs::path& folder, const map::Map& map, state::Mode mode) {
  return folder / "ghosts" /
         core::joined({core::to_hex(map.hash), "-", std::to_string(match::kBehavior),
                       mode == state::Mode::kRoam ? "" : core::joined({"-", state::to_text(mode)}),
                       ".ndjson"});
}

std::optional<protocol::ServerMessage> decoded(std::string_view line) {
  auto message = protocol::decode_server(line, {}, protocol::Format::kExact);
  return message ? std::optional(std::move(*message)) : std::nullopt;
}

/// Cuts the first line off; empty: none is left.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + 1));
  return line;
}

/// In a step of its own: a crash leaves the file of before. False: it can't be written.
bool write_whole(const fs::path& file, std::string_view text) {
  std::error_code ignored;  // then it can't be written, either
  fs::create_directories(file.parent_path(), ignored);
  return core::replace_whole_file(file, text).has_value();
}

/// Two lines of a drive, as they stand in the file; empty: none follows.
std::string_view next_drive(std::string_view& text) {
  const std::string_view rest = text;
  const auto begin = decoded(next_line(text));
  const auto driven = decoded(next_line(text));
  const auto* ack = begin ? std::get_if<protocol::Ack>(&*begin) : nullptr;
  if (ack == nullptr || !ack->you || !driven || !std::holds_alternative<protocol::GhostLine>(*driven))
    return {};
  const std::string_view drive = rest.substr(0, rest.size() - text.size());
  return drive.ends_with('\n') ? drive : std::string_view();  // one that was cut off is the last
}

/// Held while a file of the folder is read and written anew: who wrote it without, would write over what
/// another one adds. Not waited for any longer than a picture may.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    using namespace std::chrono_literals;
    constexpr int kTries = 20;
    for (int i = 0; descriptor_ >= 0 && !is_held_ && i < kTries; ++i) {
      is_held_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || (errno != EWOULDBLOCK && errno != EINTR);
      if (!is_held_) std::this_thread::sleep_for(5ms);
    }
  }
  ~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// True also where the file system has no locks; false: another one has it, or there is no such folder.
  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  int descriptor_;
  bool is_held_ = false;
};

}  // namespace

fs::path data_folder() {
  const char* const data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && *data == '/') return fs::path(data) / "woodlouse";
  const char* const home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? fs::path(home) / ".local" / "share" / "woodlouse" : fs::path();
}

std::string ghost_drives_text(const std::vector<OwnDrive>& drives, std::uint32_t tick_hz, state::Mode mode) {
  std::string text;
  for (const OwnDrive& drive : drives) {
    protocol::Ack ack;
    ack.you = protocol::ExactState{0, drive.start};
    protocol::append_ack(text, ack);
    protocol::GhostLine line;
    line.run.name = state::to_text(mode);
    line.run.time = drive.lap;
    line.behavior = match::kBehavior;
    line.tick_hz = tick_hz;
    line.ghost = {0, drive.ticks, drive.inputs};
    protocol::append_line(text, line);
  }
  return text;
}

std::vector<OwnDrive> parse_ghost_drives(std::string_view text, const map::Map& map, std::uint32_t tick_hz,
                                         state::Mode mode) {
  std::vector<OwnDrive> drives;
  while (!text.empty()) {
    const auto begin = decoded(next_line(text));
    const auto driven = decoded(next_line(text));
    const auto* ack = begin ? std::get_if<protocol::Ack>(&*begin) : nullptr;
    const auto* line = driven ? std::get_if<protocol::GhostLine>(&*driven) : nullptr;
    if (ack == nullptr || line == nullptr || !ack->you) break;
    if (line->behavior != match::kBehavior || line->tick_hz != tick_hz ||
        line->run.name != state::to_text(mode))
      continue;
    OwnDrive drive{ack->you->louse, line->ghost.inputs, line->ghost.ticks, line->run.time};
    const bool is_short =
        drive.ticks <= kMostDriveSeconds * tick_hz && drive.inputs.size() <= kMostDriveInputs;
    if (is_short && why_no_drive(map, tick_hz, drive).empty()) drives.push_back(std::move(drive));
  }
  if (drives.size() > kMostGhostsKept) drives.erase(drives.begin(), drives.end() - kMostGhostsKept);
  return drives;
}

std::vector<OwnDrive> read_ghost_drives(const fs::path& folder, const map::Map& map, std::uint32_t tick_hz,
                                        state::Mode mode) {
  const auto text = core::read_whole_file(file_of(folder, map, mode), kMostBytes);
  return text ? parse_ghost_drives(*text, map, tick_hz, mode) : std::vector<OwnDrive>();
}

bool keep_ghost_drives(const fs::path& folder, const map::Map& map, std::uint32_t tick_hz, state::Mode mode,
                       const std::vector<OwnDrive>& drives) {
  const fs::path file = file_of(folder, map, mode);
  std::error_code ignored;  // then nothing is kept
  fs::create_directories(file.parent_path(), ignored);
  const FolderLock lock(file.parent_path());
  if (!lock.is_held()) return false;
  const auto text = core::read_whole_file(file, kMostBytes);
  if (!text && fs::exists(file, ignored)) return false;  // what stands in it is not to be lost
  std::vector<std::string> kept;                         // as they are, those of other rates, too
  std::string_view rest = text ? std::string_view(*text) : std::string_view();
  for (std::string_view old = next_drive(rest); !old.empty(); old = next_drive(rest)) kept.emplace_back(old);
  for (const OwnDrive& drive : drives) kept.push_back(ghost_drives_text({drive}, tick_hz, mode));
  if (kept.size() > kMostGhostsKept) kept.erase(kept.begin(), kept.end() - kMostGhostsKept);
  std::string whole;
  for (const std::string& one : kept) whole += one;
  return write_whole(file, whole);
}

std::optional<protocol::GhostLine> read_author_ghost(const map::Map& map, std::uint32_t tick_hz) {
  const std::string& name = map.definition.name;  // a server's word: no path may come of it
  const bool is_plain = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  const auto file = is_plain ? map::find_map(name + ".json") : core::fail(name, "no shipped map's name");
  if (!file) return std::nullopt;
  const fs::path folder = file->parent_path();
  const auto text = core::read_whole_file_within(folder, folder / "ghosts" / (name + ".json"), kMostBytes);
  const auto message = text ? decoded(std::string_view(*text).substr(0, text->find('\n'))) : std::nullopt;
  const auto* line = message ? std::get_if<protocol::GhostLine>(&*message) : nullptr;
  if (line == nullptr || line->behavior != match::kBehavior || line->tick_hz != tick_hz) return std::nullopt;
  match::RunTimes said{{line->start}};
  for (const std::uint64_t split : line->run.splits) said.gates.push_back(line->start + split);
  if (!match::why_not_proven(map, tick_hz, line->ghost, said).empty()) return std::nullopt;
  return *line;
}

bool is_done(const fs::path& folder, std::string_view name) {
  std::error_code ignored;  // what can't be asked for is not done
  return fs::exists(folder / name, ignored);
}

void mark_done(const fs::path& folder, std::string_view name) {
  static_cast<void>(write_whole(folder / name, "done\n"));  // else it is not done the next time
}

}  // namespace woodlouse::client
