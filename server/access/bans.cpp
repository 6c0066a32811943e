#include "server/access/bans.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <ctime>
#include <utility>

#include "shared/core/joined.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {
namespace {

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_same(const Ban& a, const Ban& b) {
  if (a.range || b.range) return a.range == b.range;
  return is_same_name(a.name, b.name);
}

bool lasts_longer(const Ban& a, const Ban& b) {
  if (!a.until || !b.until) return !a.until && b.until;
  return *a.until > *b.until;
}

}  // namespace

std::string utc_text(WallTime time) {
  const std::time_t seconds = time.time_since_epoch().count();
  std::tm parts{};
  std::array<char, 64> text{};
  if (::gmtime_r(&seconds, &parts) == nullptr) return "a time beyond all years";
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &parts);
  assert(size > 0);
  return {text.data(), size};
}

std::string until_text(const std::optional<WallTime>& until) {
  return until ? "until " + utc_text(*until) : "for good";
}

bool is_same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return small(x) == small(y); });
}

bool goes_by(std::string_view name, std::string_view banned) {
  const std::size_t mark = name.rfind('#');
  const bool is_counted = mark != std::string_view::npos && mark + 1 < name.size() &&
                          name.find_first_not_of("0123456789", mark + 1) == std::string_view::npos;
  return is_same_name(name, banned) || (is_counted && is_same_name(name.substr(0, mark), banned));
}

core::Expected<Ban> Bans::parse(std::string_view who, WallTime now, std::optional<WallTime> until) {
  assert(!who.empty());
  auto fault = AddressRange::Fault::kNoAddress;
  Ban ban{AddressRange::parse(who, &fault), {}, now, until};
  if (ban.range) return ban;
  if (fault == AddressRange::Fault::kBadLength)
    return core::fail(std::string(who), "is no network, or one of too many",
                      "as 192.0.2.0/24 (8 to 32 bits) or 2001:db8::/48 (16 to 64)");
  if (who.find_first_not_of("0123456789./:") == std::string_view::npos &&
      who.find_first_of("./:") != who.npos)
    return core::fail(std::string(who), "looks like an address, and is none",
                      "as 192.0.2.7, 192.0.2.0/24 or 2001:db8::/48");
  if (who.size() > protocol::kMaxNameBytes)
    return core::fail(
        std::string(who), "is no address, and longer than a name",
        core::joined({"names have ", std::to_string(protocol::kMaxNameBytes), " bytes at most"}));
  ban.name = who;
  return ban;
}

core::Expected<void> Bans::add(Ban ban) {
  for (Ban& there : bans_) {
    if (!is_same(there, ban)) continue;
    there = std::move(ban);
    return {};
  }
  if (bans_.size() >= kMost)
    return core::fail({}, core::joined({"there are ", std::to_string(kMost), " bans already"}),
                      "one of a network takes the place of many");
  bans_.push_back(std::move(ban));
  return {};
}

bool Bans::remove(const Ban& ban) {
  return std::erase_if(bans_, [&ban](const Ban& there) { return is_same(there, ban); }) != 0;
}

void Bans::drop_over(WallTime now) {
  std::erase_if(bans_, [now](const Ban& ban) { return ban.is_over(now); });
}

const Ban* Bans::of(const boost::asio::ip::address& address, WallTime now) const {
  return bans_.empty() ? nullptr : of(AddressRange::of(address), now);
}

const Ban* Bans::of(const AddressRange& addresses, WallTime now) const {
  const Ban* longest = nullptr;
  for (const Ban& ban : bans_)
    if (ban.range && !ban.is_over(now) && ban.range->contains(addresses) &&
        (longest == nullptr || lasts_longer(ban, *longest)))
      longest = &ban;
  return longest;
}

const Ban* Bans::of(std::string_view name, WallTime now) const {
  for (const Ban& ban : bans_)
    if (!ban.range && !ban.is_over(now) && goes_by(name, ban.name)) return &ban;
  return nullptr;
}

}  // namespace woodlouse::server
