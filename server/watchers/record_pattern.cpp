#include "server/watchers/record_pattern.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <optional>
#include <system_error>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/sink_file.h"
#include "shared/state/mode.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;
using core::joined;

constexpr std::string_view kRoom = "{room}";
constexpr std::string_view kInFolder = "{room}-%Y%m%dT%H%M%SZ";
constexpr std::string_view kPacked = ".ndjson.zst";

/// What strftime writes for a field: a 0 stands for any digit.
struct TimeField {
  char letter;
  std::string_view shape;
};
/// Nothing that another place writes otherwise, and nothing that a file's name can't have.
constexpr std::array<TimeField, 12> kTimeFields{{{'Y', "0000"},
                                                 {'y', "00"},
                                                 {'m', "00"},
                                                 {'d', "00"},
                                                 {'H', "00"},
                                                 {'M', "00"},
                                                 {'S', "00"},
                                                 {'j', "000"},
                                                 {'F', "0000-00-00"},
                                                 {'G', "0000"},
                                                 {'V', "00"},
                                                 {'u', "0"}}};

std::optional<std::string_view> shape_of(char letter) {
  const auto* const field = std::find_if(kTimeFields.begin(), kTimeFields.end(),
                                         [letter](const TimeField& one) { return one.letter == letter; });
  if (field == kTimeFields.end()) return std::nullopt;
  return field->shape;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool ends_with_kind(std::string_view name) { return name.ends_with(".ndjson") || name.ends_with(".zst"); }

core::Expected<void> check_name(const std::string& text, std::string_view name) {
  bool has_room = false;
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (name[at] == '{' || name[at] == '}') {
      if (has_room || name.substr(at, kRoom.size()) != kRoom)
        return core::fail("--record " + text, "has a brace that is not that of one {room}",
                          "{room} is the only word in braces, and stands there once");
      has_room = true;
      at += kRoom.size() - 1;
    } else if (name[at] == '%') {
      const std::string_view letter = name.substr(++at, 1);
      if (letter == "%" || (!letter.empty() && shape_of(letter[0]))) continue;
      return core::fail("--record " + text,
                        letter.empty() ? "ends in a %" : joined({"%", letter, " is no field of a name"}),
                        "fields are %Y %m %d %H %M %S %j %y %F %G %V %u, UTC, and %% for a percent sign");
    }
  }
  return {};
}

core::Expected<std::string> folder_of(const std::string& text, std::string_view folder) {
  std::string result;
  for (std::size_t at = 0; at < folder.size(); ++at) {
    if (folder[at] == '%' && folder.substr(++at, 1) != "%")
      return core::fail("--record " + text, "has a field in its folder",
                        "fields stand in the name alone, {room}-%F for example; %% is a percent sign");
    if (folder.substr(at, kRoom.size()) == kRoom)
      return core::fail("--record " + text, "has {room} in its folder", "it stands in the name alone");
    result += folder[at];
  }
  return result;
}

/// game.ndjson: game.{room}.ndjson
std::string with_word(const std::string& name, std::string_view word) {
  const fs::path file(name);
  const std::string packed = file.extension() == ".zst" ? ".zst" : "";
  const fs::path plain = packed.empty() ? file : file.stem();
  return joined({plain.stem().string(), ".", word, plain.extension().string(), packed});
}
std::string with_room(const std::string& name) { return with_word(name, kRoom); }

/// volcano/race: race; volcano: nothing.
std::string_view mode_part(std::string_view room) {
  const std::size_t slash = room.rfind('/');
  return slash == std::string_view::npos ? std::string_view() : room.substr(slash + 1);
}

bool fits(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern.starts_with(kRoom)) {
    // What file_part() leaves of a room.
    const std::size_t longest = std::min(name.find_first_of("/\\. "), name.size());
    for (std::size_t size = 1; size <= longest; ++size)
      if (fits(pattern.substr(kRoom.size()), name.substr(size))) return true;
    return false;
  }
  const std::string_view shape =
      pattern[0] == '%' ? shape_of(pattern[1]).value_or("%") : pattern.substr(0, 1);
  if (name.size() < shape.size()) return false;
  const bool is_field = pattern[0] == '%' && pattern[1] != '%';
  for (std::size_t at = 0; at < shape.size(); ++at)
    if (is_field && shape[at] == '0' ? !is_digit(name[at]) : name[at] != shape[at]) return false;
  return fits(pattern.substr(pattern[0] == '%' ? 2 : 1), name.substr(shape.size()));
}

}  // namespace

std::string file_part(std::string room) {
  std::replace_if(
      room.begin(), room.end(), [](char c) { return c == '/' || c == '\\' || c == '.' || c == ' '; }, '_');
  return room;
}

RecordPattern::RecordPattern(fs::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {}

core::Expected<RecordPattern> RecordPattern::parse(const std::string& text, std::size_t rooms) {
  if (text.empty()) return core::fail("--record", "names no file", "for example  --record recordings/");
  const std::size_t slash = text.rfind('/');
  const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
  auto folder = folder_of(text, std::string_view(text).substr(0, begin));
  if (!folder) return tl::unexpected(folder.error());
  std::string name = text.substr(begin);
  std::error_code error;
  // A name with fields is none of a folder: it can't be what is meant where it stands for others too.
  const bool is_plain = name.find_first_of("%{}") == std::string::npos;
  if (name.empty()) {
    name = joined({kInFolder, kPacked});
  } else if (is_plain && fs::is_directory(*folder + name, error)) {
    *folder += name + '/';
    name = joined({kInFolder, kPacked});
  } else if (is_plain && fs::is_other(*folder + name, error)) {
    return RecordPattern(*folder, rooms > 1 ? with_room(name) : name);
  }
  if (auto good = check_name(text, name); !good) return tl::unexpected(good.error());
  if (!ends_with_kind(name)) name += kPacked;
  if (rooms > 1 && name.find(kRoom) == std::string::npos) name = with_room(name);
  return RecordPattern(*folder, name);
}

fs::path RecordPattern::file(const std::string& room, std::int64_t time) const {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  std::string result;
  const std::string_view mode = mode_part(room);
  const std::string name = has_modes_apart() && !mode.empty() ? with_word(name_, mode) : name_;
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (name[at] == '%') {
      const std::array<char, 3> field{'%', name[++at], '\0'};
      std::array<char, 32> written{};
      result.append(written.data(), std::strftime(written.data(), written.size(), field.data(), &utc));
    } else if (name[at] == '{') {
      result += file_part(room);
      at += kRoom.size() - 1;
    } else {
      result += name[at];
    }
  }
  return folder_ / result;
}

bool RecordPattern::has_modes_apart() const { return name_.find(kRoom) == std::string::npos; }

bool RecordPattern::matches(const std::string& name) const {
  if (matches(name_, name)) return true;
  return has_modes_apart() && std::any_of(state::kModes.begin(), state::kModes.end(), [&](state::Mode mode) {
           return mode != state::Mode::kRoam && matches(with_word(name_, state::to_text(mode)), name);
         });
}

bool RecordPattern::matches(const std::string& pattern, const std::string& name) {
  if (fits(pattern, name)) return true;
  // Or one of a number, which is taken out again.
  for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
    std::size_t end = dot + 1;
    std::size_t number = 0;
    while (end < name.size() && is_digit(name[end]) && number <= core::kMaxFileNumber)
      number = number * 10 + static_cast<std::size_t>(name[end++] - '0');
    if (number == 0 || number > core::kMaxFileNumber) continue;
    const std::string plain = name.substr(0, dot) + name.substr(end);
    if (core::numbered(plain, number) == name && fits(pattern, plain)) return true;
  }
  return false;
}

}  // namespace woodlouse::server
