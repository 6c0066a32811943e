#include "server/access/ban_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/whole_file.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/protocol/messages.h"
#include "shared/protocol/text_cleaning.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFileBytes = 1u << 20;
constexpr json::Limits kBanLimits{2, 16};
constexpr std::size_t kMostAddressBytes = 64;           // of IPv6, with how many bits of it count
constexpr std::uint64_t kLastSecond = 253'402'300'799;  // of the year 9999

WallTime wall_time(std::uint64_t seconds) {
  return WallTime(std::chrono::seconds(static_cast<std::int64_t>(seconds)));
}

core::Expected<Ban> read_ban(std::string_view text, const std::string& name, std::size_t number) {
  const auto document = json::parse_file(text, name, kBanLimits, number);
  if (!document) return tl::unexpected(document.error());
  const std::string where = core::joined({name, ":", std::to_string(number)});
  if (!document->root().is(json::Kind::kObject))
    return core::fail(where, "is no ban", R"(as {"address":"192.0.2.7"} or {"name":"ann"})");
  json::Problems problems(name);
  const json::Fields fields(document->root(), {"address", "name", "since", "until"}, problems);
  const auto address = fields.find("address");
  const auto banned_name = fields.find("name");
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());  // a misspelt name, above all
  if (address.has_value() == banned_name.has_value())
    return core::fail(where, "a ban has an address or a name, one of them");
  Ban ban;
  const auto who = address ? json::text_in(*address, 1, kMostAddressBytes, problems)
                           : json::text_in(*banned_name, 1, protocol::kMaxNameBytes, problems);
  if (const auto since = fields.find("since"))
    ban.since = wall_time(json::integer_in(*since, 0, kLastSecond, problems).value_or(0));
  if (const auto until = fields.find("until"))
    ban.until = wall_time(json::integer_in(*until, 0, kLastSecond, problems).value_or(0));
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  if (address) {
    ban.range = AddressRange::parse(*who);
    if (!ban.range) return core::fail(where, core::joined({"\"", *who, "\" is no address, nor a network"}));
  } else {
    ban.name = protocol::clean_text(*who, protocol::kMaxNameBytes);
    if (ban.name.empty()) return core::fail(where, "a name without anything to be seen is nobody's");
  }
  return ban;
}

int write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::string file_text(const Bans& bans) {
  std::string text;
  for (const Ban& ban : bans.all()) {
    json::ObjectText line(text);
    line.text(ban.range ? "address" : "name", ban.who());
    line.integer("since", ban.since.time_since_epoch().count());
    if (ban.until) line.integer("until", ban.until->time_since_epoch().count());
    line.end_line();
  }
  return text;
}

}  // namespace

core::Expected<Bans> read_bans(const fs::path& file) {
  Bans bans;
  std::error_code error;
  if (!fs::exists(file, error) && !error) return bans;
  const std::string name = "--ban-file " + file.string();
  const auto bytes = core::read_whole_file(file, kMostFileBytes);
  if (!bytes) return core::fail(name, bytes.error().what, bytes.error().hint);
  std::string_view rest = *bytes;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    auto ban = read_ban(line, name, number);
    if (!ban) return tl::unexpected(ban.error());
    if (auto added = bans.add(std::move(*ban)); !added)
      return core::fail(name, added.error().what, added.error().hint);
  }
  return bans;
}

core::Expected<void> write_bans(const fs::path& file, const Bans& bans) {
  const fs::path fresh = fs::path(file) += ".new";
  const auto failed = [&fresh](int error) {
    return core::fail("--ban-file " + fresh.string(), std::generic_category().message(error),
                      "the bans in force and their file are as they were");
  };
  const int descriptor =
      ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  if (descriptor < 0) return failed(errno);
  int error = write_whole(descriptor, file_text(bans));
  if (error == 0 && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(fresh.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(fresh.c_str());
    return failed(error);
  }
  // The new name is on the disk, too; where the folder can't be asked, it will be soon.
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  const int there = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (there >= 0) {
    static_cast<void>(::fsync(there));
    ::close(there);
  }
  return {};
}

}  // namespace woodlouse::server
