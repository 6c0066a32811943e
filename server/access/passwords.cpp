#include "server/access/passwords.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "shared/core/joined.h"
#include "shared/core/whole_file.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kMostPasswordBytes = 1u << 18;  // of the file

constexpr std::array<std::pair<std::string_view, Right>, 3> kRights = {
    {{"player", Right::kPlayer}, {"moderator", Right::kModerator}, {"admin", Right::kAdmin}}};

std::string_view next_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

}  // namespace

core::Expected<Passwords> Passwords::parse(std::string_view text, const std::string& name) {
  Passwords passwords;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    const std::string where = core::joined({name, ":", std::to_string(number)});
    const std::string_view role = next_word(line);
    if (role.empty() || role.starts_with('#')) continue;
    const auto found = std::find_if(kRights.begin(), kRights.end(),
                                    [role](const auto& right) { return right.first == role; });
    if (found == kRights.end())
      return core::fail(where, "does not begin with a role",
                        "a line is `player TOKEN`, or moderator, or admin");
    const std::string_view token = next_word(line);
    if (!may_be_secret(token))
      return core::fail(where, "has no token of 8 to 256 visible ASCII characters",
                        "make one:  head -c 24 /dev/urandom | base64");
    const std::string_view rest = next_word(line);
    if (!rest.empty() && !rest.starts_with('#'))
      return core::fail(where, "says more than a role and a token");
    if (passwords.right_of(token)) return core::fail(where, "has a token that stands above already");
    if (passwords.tokens_.size() >= kMost)
      return core::fail(where, "is one token too many", core::joined({"at most ", std::to_string(kMost)}));
    passwords.tokens_.emplace_back(Secret(token), found->second);
  }
  if (passwords.tokens_.empty())
    return core::fail(name, "has no token: nobody could join", "a line is `player TOKEN`");
  return passwords;
}

std::optional<Right> Passwords::right_of(std::string_view token) const {
  std::optional<Right> right;
  const Secret::Digest digest = Secret::digest_of(token);
  for (const auto& [secret, its] : tokens_)
    if (secret.matches(digest)) right = its;
  return right;
}

core::Expected<Passwords> read_passwords(const std::filesystem::path& file) {
  const std::string name = "--password-file " + file.string();
  const auto bytes = core::read_whole_file(file, kMostPasswordBytes);
  if (!bytes) return core::fail(name, bytes.error().what, bytes.error().hint);
  return Passwords::parse(*bytes, name);
}

TokenBucket& WrongTokens::bucket(std::string_view address, Time now) {
  if (of_.size() >= kMostAddresses && !of_.contains(address)) {
    for (auto at = of_.begin(); at != of_.end();)
      at = at->second.is_full(now) ? of_.erase(at) : std::next(at);
    if (of_.size() >= kMostAddresses) address = {};
  }
  const auto found = of_.find(address);
  if (found != of_.end()) return found->second;
  return of_.emplace(address, TokenBucket(1.0 / kAgainSeconds, kAtOnce, now)).first->second;
}

Duration WrongTokens::wait(std::string_view address, Time now) {
  if (of_.empty()) return {};
  TokenBucket& its = bucket(address, now);
  its.charge(0.0, now);
  return its.wait(1.0);
}

void WrongTokens::count(std::string_view address, Time now) { bucket(address, now).charge(1.0, now); }

}  // namespace woodlouse::server
