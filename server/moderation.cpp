#include "server/moderation.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "server/admin/answer.h"
#include "server/logging/events.h"
#include "server/room_control.h"
#include "shared/core/printable.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using Kind = RosterEntry::Kind;

/// The number of a louse: digits alone.
std::optional<match::PlayerId> louse_of(const std::string& who) {
  match::PlayerId louse = 0;
  const auto [end, error] = std::from_chars(who.data(), who.data() + who.size(), louse);
  if (error != std::errc() || end != who.data() + who.size() || louse == 0) return std::nullopt;
  return louse;
}

/// By name, or by the number of the louse.
std::function<bool(const RosterEntry&)> called(const std::string& who) {
  return [who, louse = louse_of(who)](const RosterEntry& entry) {
    return is_same_name(entry.name, who) || (louse && entry.louse == *louse);
  };
}

std::optional<WallTime> end_of(const Command& command, WallTime now) {
  if (!command.seconds) return std::nullopt;
  return now + std::chrono::seconds(static_cast<std::int64_t>(*command.seconds));
}

/// A number is a louse of each room: who is put out must not hang on who else is called so. Empty: it is
/// clear.
std::string why_unclear(const std::string& who, std::size_t found) {
  if (found < 2 || !louse_of(who)) return {};
  return refused(admin_code::kNotNow,
                 fmt::format("{} of the lice here may be meant by {}: say which room (--room), or a "
                             "name; `rooms ROOM` lists them",
                             found, who));
}

/// As the server numbers a second one of a name: ann#2.
bool is_numbered(std::string_view name) {
  const std::size_t sign = name.rfind('#');
  return sign != std::string_view::npos && sign != 0 && louse_of(std::string(name.substr(sign + 1)));
}

std::string nobody(const std::string& who) {
  return refused(
      admin_code::kNobody,
      fmt::format("nobody here is called \"{}\", nor has a louse of that number", core::printable(who)));
}

}  // namespace

void Moderation::find(const IsMeant& is_meant, const std::string& room, OnFound on_found) {
  struct Search {
    std::mutex mutex;
    std::vector<Found> found;
    std::size_t missing = 0;
  };
  const auto rooms = chosen_rooms(lobby_, room);
  if (rooms.empty()) return on_found({});
  const auto search = std::make_shared<Search>();
  search->missing = rooms.size();
  for (const auto& one : rooms)
    one->ask_roster([this, one, search, is_meant, on_found](const std::vector<RosterEntry>& roster) {
      const std::lock_guard lock(search->mutex);
      for (const RosterEntry& entry : roster)
        if (is_meant(entry)) search->found.push_back({one, entry});
      if (--search->missing != 0) return;
      asio::post(strand_, [search, on_found] { on_found(std::move(search->found)); });
    });
}

/// Also those who are away and might come back.
void Moderation::expel(const std::vector<Found>& found, protocol::ErrorMessage why,
                       std::function<void()> done) {
  std::set<SessionId> sessions;
  for (const Found& one : found) {
    if (one.entry.kind == Kind::kSession) sessions.insert(one.entry.session);
    if (one.entry.kind == Kind::kAway) one.room->give_up(one.entry.louse);
  }
  acceptor_.expel(
      [sessions = std::move(sessions)](SessionId id, const std::string&) { return sessions.contains(id); },
      std::move(why), [done = std::move(done)](std::size_t) { done(); });
}

void Moderation::list(const Command& command, const Answered& answered) {
  if (chosen_rooms(lobby_, command.room).empty()) return answered(no_such_room(lobby_, command.room));
  find([](const RosterEntry&) { return true; }, command.room,
       [this, answered](std::vector<Found> found) {
         acceptor_.ask_addresses([found = std::move(found),
                                  answered](const std::map<SessionId, std::string>& addresses) {
           const auto address_of = [&addresses](const Found& one) {
             const auto its = addresses.find(one.entry.session);
             return its == addresses.end() ? std::string() : its->second;
           };
           std::string text = fmt::format("{:>6} {:<24} {:<10} {}", "louse", "name", "role", "from");
           for (const Found& one : found) {
             std::string from = one.entry.kind == Kind::kHouse  ? "the house"
                                : one.entry.kind == Kind::kAway ? "(away)"
                                                                : address_of(one);
             if (one.entry.is_muted) from += " muted";
             text += fmt::format("\n{:>6} {:<24} {:<10} {}", one.entry.louse, core::printable(one.entry.name),
                                 protocol::to_text(one.entry.role), from);
           }
           answered(done(text, [&](json::ObjectText& object) {
             object.objects("members", found, [&](json::ObjectText& row, const Found& one) {
               row.integer("louse", one.entry.louse).text("name", one.entry.name);
               row.text("role", protocol::to_text(one.entry.role));
               row.boolean("house", one.entry.kind == Kind::kHouse)
                   .boolean("away", one.entry.kind == Kind::kAway)
                   .boolean("muted", one.entry.is_muted);
               if (const std::string address = address_of(one); !address.empty())
                 row.hash("session", one.entry.session).text("address", address);
             });
           }));
         });
       });
}

void Moderation::kick(const Command& command, Answered answered) {
  if (!command.room.empty() && chosen_rooms(lobby_, command.room).empty())
    return answered(no_such_room(lobby_, command.room));
  find(called(command.who), command.room, [this, who = command.who, answered](std::vector<Found> found) {
    const bool has_bots =
        std::erase_if(found, [](const Found& one) { return one.entry.kind == Kind::kHouse; }) != 0;
    if (found.empty() && has_bots)
      return answered(
          refused(admin_code::kNotNow,
                  fmt::format("\"{}\" is one of the house's own bots: --bots says how many there are",
                              core::printable(who))));
    if (found.empty()) return answered(nobody(who));
    if (auto unclear = why_unclear(who, found.size()); !unclear.empty()) return answered(std::move(unclear));
    log_event(*log_, LogEvent::kKicked, fmt::format("admin: kicked \"{}\"", who));
    std::string text;
    for (const Found& one : found)
      text += fmt::format("{}kicked \"{}\" from {}", text.empty() ? "" : "\n",
                          core::printable(one.entry.name), core::printable(one.room->name()));
    expel(found, {std::string(protocol::code::kKicked), "the operator has ended your connection", true, {}},
          [answered, text, count = found.size()] {
            answered(done(text, [count](json::ObjectText& object) { object.integer("count", count); }));
          });
  });
}

void Moderation::ban(const Command& command, const Answered& answered) {
  assert(desk_);
  const WallTime now = wall_now();
  const auto ban = Bans::parse(command.who, now, end_of(command, now));
  if (!ban) return answered(refused(protocol::code::kBadField, ban.error().text()));
  const bool is_taken = desk_->change(
      [ban = *ban](Bans& bans) { return bans.add(ban); },
      [this, ban = *ban, answered](const core::Expected<void>& changed) {
        if (!changed) {
          log_event(*log_, LogEvent::kBanFailed,
                    fmt::format("admin: {} is NOT banned: {}", ban.who(), changed.error().text()));
          return answered(refused(admin_code::kFailed, changed.error().text()));
        }
        asio::post(strand_, [this, ban, answered] { apply(ban, answered); });
      });
  if (!is_taken) answered(refused(admin_code::kNotNow, "too many changes wait for the disk"));
}

/// Who is here and should not be goes.
void Moderation::apply(const Ban& ban, const Answered& answered) {
  log_event(*log_, LogEvent::kBanned,
            fmt::format("admin: {} is banned {}", ban.who(), until_text(ban.until)));
  const std::string text =
      fmt::format("{} is banned {}{}{}", core::printable(ban.who()), until_text(ban.until),
                  desk_->has_file() ? "" : ", or as long as this server: it has no --ban-file",
                  !ban.range && is_numbered(ban.name)
                      ? ", who is called so because another one of the name came first: he may join again "
                        "without the number; `rooms ROOM` shows his address"
                      : "");
  const auto tell = [answered, text, ban](std::size_t ended) {
    answered(done(fmt::format("{}; {} connections ended", text, ended), [&](json::ObjectText& object) {
      object.text("who", ban.who()).integer("ended", ended);
      if (ban.until) object.integer("until", ban.until->time_since_epoch().count());
    }));
  };
  if (ban.range)
    return acceptor_.expel(
        [range = *ban.range](SessionId, const std::string& address) {
          const auto its = AddressRange::parse(address);
          return its && range.contains(*its);
        },
        banned_error(ban), tell);
  find(
      [ban](const RosterEntry& entry) { return entry.kind != Kind::kHouse && goes_by(entry.name, ban.name); },
      {},
      [this, ban, tell](const std::vector<Found>& found) {
        expel(found, banned_error(ban), [tell, count = found.size()] { tell(count); });
      });
}

void Moderation::enforce_bans(std::function<void(std::size_t)> done) {
  asio::post(strand_, [this, done = std::move(done)] {
    const auto bans = std::make_shared<const Bans>(doorman_.bans());
    const auto any = [bans](const auto& is_meant) {
      return std::any_of(bans->all().begin(), bans->all().end(),
                         [&](const Ban& ban) { return !ban.is_over(wall_now()) && is_meant(ban); });
    };
    const protocol::ErrorMessage why{
        std::string(protocol::code::kBanned), "the operator has banned you", true, {}};
    const auto is_banned = [any](const RosterEntry& entry) {
      return entry.kind != Kind::kHouse &&
             any([&](const Ban& ban) { return !ban.range && goes_by(entry.name, ban.name); });
    };
    find(is_banned, {}, [this, any, why, done](const std::vector<Found>& found) {
      expel(found, why, [this, any, why, done, count = found.size()] {
        const auto is_meant = [any](SessionId, const std::string& address) {
          const auto its = AddressRange::parse(address);
          return its && any([&](const Ban& ban) { return ban.range && ban.range->contains(*its); });
        };
        acceptor_.expel(is_meant, why, [done, count](std::size_t ended) { done(count + ended); });
      });
    });
  });
}

void Moderation::unban(const Command& command, const Answered& answered) {
  assert(desk_);
  const auto ban = Bans::parse(command.who, wall_now(), std::nullopt);
  if (!ban) return answered(refused(protocol::code::kBadField, ban.error().text()));
  const bool is_taken = desk_->change(
      [ban = *ban](Bans& bans) -> core::Expected<void> {
        if (bans.remove(ban)) return {};
        return core::fail(ban.who(), "is not banned", "`bans` says who is");
      },
      [this, ban = *ban, answered](const core::Expected<void>& changed) {
        if (!changed) return answered(refused(admin_code::kFailed, changed.error().text()));
        log_event(*log_, LogEvent::kUnbanned, fmt::format("admin: {} is banned no more", ban.who()));
        answered(done(fmt::format("{} is banned no more", core::printable(ban.who()))));
      });
  if (!is_taken) answered(refused(admin_code::kNotNow, "too many changes wait for the disk"));
}

std::string Moderation::bans() const {
  Bans bans = doorman_.bans();
  bans.drop_over(wall_now());
  std::string text;
  for (const Ban& ban : bans.all())
    text += fmt::format("{}{:<40} {}", text.empty() ? "" : "\n", core::printable(ban.who()),
                        until_text(ban.until));
  return done(text.empty() ? "nobody is banned" : text, [&bans](json::ObjectText& object) {
    object.objects("bans", bans.all(), [](json::ObjectText& row, const Ban& ban) {
      row.text(ban.range ? "address" : "name", ban.who());
      row.integer("since", ban.since.time_since_epoch().count());
      if (ban.until) row.integer("until", ban.until->time_since_epoch().count());
    });
  });
}

void Moderation::mute(const Command& command, const Answered& answered) {
  const WallTime now = wall_now();
  const auto until = end_of(command, now);
  if (const auto range = AddressRange::parse(command.who)) {
    const WallTime end = until.value_or(now + kMuteOfAddress);
    doorman_.mute({*range, end}, now);
    log_event(*log_, LogEvent::kMuted, fmt::format("admin: {} is muted {}", range->text(), until_text(end)));
    return answered(done(fmt::format("{} is muted {}", range->text(), until_text(end))));
  }
  find(called(command.who), command.room,
       [this, who = command.who, until, now, answered](std::vector<Found> found) {
         std::erase_if(found, [](const Found& one) { return one.entry.kind == Kind::kHouse; });
         if (found.empty()) return answered(nobody(who));
         if (auto unclear = why_unclear(who, found.size()); !unclear.empty())
           return answered(std::move(unclear));
         for (const Found& one : found)
           one.room->mute(one.entry, until ? std::optional<Duration>(*until - now) : std::nullopt);
         log_event(*log_, LogEvent::kMuted, fmt::format("admin: \"{}\" is muted", who));
         answered(done(
             fmt::format("\"{}\" is muted {}", core::printable(who),
                         until ? until_text(until) + ", or as long as he is here" : "as long as he is here"),
             [&found](json::ObjectText& object) { object.integer("count", found.size()); }));
       });
}

void Moderation::unmute(const Command& command, const Answered& answered) {
  if (const auto range = AddressRange::parse(command.who)) {
    if (doorman_.unmute(*range) == 0)
      return answered(refused(admin_code::kNobody, range->text() + " is not muted"));
    return answered(done(range->text() + " is muted no more"));
  }
  find(called(command.who), command.room,
       [this, who = command.who, answered](const std::vector<Found>& found) {
         std::size_t count = 0;
         for (const Found& one : found)
           if (one.entry.is_muted) {
             one.room->unmute(one.entry);
             ++count;
           }
         if (count == 0)
           return answered(refused(admin_code::kNobody,
                                   fmt::format("nobody called \"{}\" is muted", core::printable(who))));
         answered(done(fmt::format("\"{}\" is muted no more", core::printable(who))));
       });
}

std::string Moderation::say(const Command& command) {
  const auto rooms = chosen_rooms(lobby_, command.room);
  if (rooms.empty()) return no_such_room(lobby_, command.room);
  for (const auto& room : rooms) room->say({std::string(protocol::code::kOperator), command.text});
  return done(fmt::format("said in {} room{}", rooms.size(), rooms.size() == 1 ? "" : "s"));
}

}  // namespace woodlouse::server
