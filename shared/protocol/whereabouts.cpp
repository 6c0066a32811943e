#include "shared/protocol/whereabouts.h"

#include <algorithm>
#include <cassert>
#include <charconv>

namespace woodlouse::protocol {
namespace {

constexpr std::size_t kLongestName = 253;  ///< of the name system

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

/// In digits alone, without zeros before it.
std::optional<unsigned> number_of(std::string_view text, unsigned most) {
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  if (text.size() > 1 && text.front() == '0') return std::nullopt;
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number > most) return std::nullopt;
  assert(end == text.data() + text.size());
  return number;
}

bool is_v4(std::string_view text) {
  for (int k = 0; k < 4; ++k) {
    const std::size_t dot = text.find('.');
    if ((dot == std::string_view::npos) != (k == 3)) return false;
    if (!number_of(text.substr(0, dot), 255)) return false;
    if (k < 3) text.remove_prefix(dot + 1);
  }
  return true;
}

/// Of 16 bits each, with colons between them; the last two may be written as IPv4's four numbers.
std::optional<int> groups_of(std::string_view text, bool may_end_as_v4) {
  int groups = 0;
  while (!text.empty()) {
    const std::size_t colon = text.find(':');
    const std::string_view group = text.substr(0, colon);
    const bool is_last = colon == std::string_view::npos;
    if (is_last && may_end_as_v4 && is_v4(group)) return groups + 2;
    if (group.empty() || group.size() > 4 || !std::all_of(group.begin(), group.end(), is_hex))
      return std::nullopt;
    ++groups;
    if (is_last) return groups;
    text.remove_prefix(colon + 1);
    if (text.empty()) return std::nullopt;  // it ends in a colon
  }
  return groups;
}

/// Without the zone of a link, which means nothing on another machine.
bool is_v6(std::string_view text) {
  constexpr int kGroups = 8;
  const std::size_t gap = text.find("::");
  if (gap == std::string_view::npos) return groups_of(text, true) == kGroups;
  const auto before = groups_of(text.substr(0, gap), false);
  const auto after = groups_of(text.substr(gap + 2), true);
  return before && after && *before + *after < kGroups;
}

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > kLongestName) return false;
  if (!is_digit(text.front()) && !is_letter(text.front())) return false;
  // What looks like a number but is none would be looked up by somebody's rules of his own.
  if (std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c) || c == '.'; }))
    return is_v4(text);
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return is_digit(c) || is_letter(c) || c == '-' || c == '.' || c == '_'; });
}

}  // namespace

std::string HostAddress::text() const {
  const bool is_v6 = host.find(':') != std::string::npos;
  return (is_v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

std::optional<HostAddress> parse_host_address(std::string_view text) {
  if (text.size() > kMaxAddressBytes) return std::nullopt;
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto port = number_of(text.substr(colon + 1), 65535);
  if (!port || *port == 0) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  const bool has_brackets = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (has_brackets) host = host.substr(1, host.size() - 2);
  if (has_brackets ? !is_v6(host) : !is_name(host)) return std::nullopt;
  return HostAddress{std::string(host), static_cast<std::uint16_t>(*port)};
}

void Whereabouts::welcomed(const std::vector<std::string>& hosts) {
  const HostAddress here = place();
  places_ = {here};
  at_ = 0;
  for (const std::string& text : hosts) {
    const auto host = parse_host_address(text);
    if (host && std::find(places_.begin(), places_.end(), *host) == places_.end()) places_.push_back(*host);
  }
  assert(place() == here);
}

Whereabouts::Sent Whereabouts::moved(std::string_view address, std::optional<double> up_for) {
  settle(up_for);
  const auto there = parse_host_address(address);
  if (!there) return Sent::kNoAddress;
  if (moves_ == kMostMoves) return Sent::kTooOften;
  ++moves_;
  const auto known = std::find(places_.begin(), places_.end(), *there);
  at_ = static_cast<std::size_t>(known - places_.begin());
  if (known == places_.end()) {
    at_ = 0;
    places_.insert(places_.begin(), *there);
    if (places_.size() > kMaxHosts + kMostMoves) places_.pop_back();  // whoever sends on for long names many
  }
  assert(place() == *there);
  return Sent::kFollows;
}

double Whereabouts::lost(std::optional<double> up_for, double chance) {
  assert(chance >= 0.0 && chance <= 1.0);
  settle(up_for);
  if (!up_for) at_ = (at_ + 1) % places_.size();
  moves_ = 0;  // the wait is between them
  const double wait = std::min(kLongestWait, kFirstWait * static_cast<double>(1u << std::min(waits_, 10)));
  ++waits_;
  return wait * (0.5 + chance);
}

void Whereabouts::settle(std::optional<double> up_for) {
  if (up_for.value_or(0.0) < kSettled) return;
  moves_ = waits_ = 0;
}

}  // namespace woodlouse::protocol
