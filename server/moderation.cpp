#include "server/moderation.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <map>
#include <mutex>
#include <set>
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

/// The number of a louse: digits alone, as numbers are written.
std::optional<match::PlayerId> louse_of(const std::string& who) {
  match::PlayerId louse = 0;
  const auto [end, error] = std::from_chars(who.data(), who.data() + who.size(), louse);
  if (error != std::errc() || end != who.data() + who.size() || who.starts_with('0')) return std::nullopt;
  return louse;
}

/// By name, or by the number of the louse.
std::function<bool(const RosterEntry&)> called(const std::string& who) {
  return [who, louse = louse_of(who)](const RosterEntry& entry) {
    return is_same_name(entry.name, who) || (louse && entry.louse == *louse);
  };
}

/// A number is a louse of each room: who is put out must not hang on who else is called so. Empty: it is
/// clear. Of a name all are meant that have it.
std::string why_unclear(const std::string& who, std::size_t found, bool is_name) {
  if (found < 2 || is_name || !louse_of(who)) return {};
  return refused(admin_code::kNotNow,
                 fmt::format("{} of the lice here may be meant by {}: say which room (--room), or a "
                             "name; `rooms ROOM` lists them",
                             found, who));
}

/// In a room people are meant: there a name may look like an address.
std::optional<AddressRange> address_of(const Command& command) {
  return command.room.empty() ? AddressRange::parse(command.who) : std::nullopt;
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

/// Who has it as his name comes before whose louse has that number: else a name would be a shield.
void Moderation::find_called(const std::string& who, const std::string& room,
                             std::function<void(std::vector<Found> found, std::string why_not)> on_found) {
  find(called(who), room, [who, on_found = std::move(on_found)](std::vector<Found> found) {
    const auto has_name = [&who](const Found& one) { return is_same_name(one.entry.name, who); };
    const bool is_name = std::any_of(found.begin(), found.end(), has_name);
    if (is_name) std::erase_if(found, [&](const Found& one) { return !has_name(one); });
    const bool has_bots =
        std::erase_if(found, [](const Found& one) { return one.entry.kind == Kind::kHouse; }) != 0;
    std::string why_not = why_unclear(who, found.size(), is_name);
    if (found.empty())
      why_not = has_bots ? refused(admin_code::kNotNow,
                                   fmt::format("\"{}\" is one of the house's own bots: --bots says how "
                                               "many there are",
                                               core::printable(who)))
                         : nobody(who);
    on_found(std::move(found), std::move(why_not));
  });
}

/// Also those who are away and might come back, and who has done so since they were found.
void Moderation::expel(const std::vector<Found>& found, protocol::ErrorMessage why,
                       std::function<void()> done) {
  struct Round {
    std::mutex mutex;
    std::set<SessionId> sessions;
    std::size_t missing = 0;
  };
  std::map<std::shared_ptr<Room>, std::vector<RosterEntry>> of_room;
  for (const Found& one : found) of_room[one.room].push_back(one.entry);
  if (of_room.empty()) return done();
  const auto round = std::make_shared<Round>();
  round->missing = of_room.size();
  for (auto& [room, entries] : of_room)
    room->put_out(std::move(entries), [this, round, why, done](const std::vector<SessionId>& here) {
      std::set<SessionId> sessions;
      {
        const std::lock_guard lock(round->mutex);
        round->sessions.insert(here.begin(), here.end());
        if (--round->missing != 0) return;
        sessions = std::move(round->sessions);
      }
      acceptor_.expel([sessions = std::move(sessions)](SessionId id,
                                                       const std::string&) { return sessions.contains(id); },
                      why, [done](std::size_t) { done(); });
    });
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
  find_called(
      command.who, command.room,
      [this, who = command.who, answered](const std::vector<Found>& found, std::string why_not) {
        if (!why_not.empty()) return answered(std::move(why_not));
        log_event(*log_, LogEvent::kKicked, fmt::format("admin: kicked \"{}\"", who));
        std::string text;
        for (const Found& one : found)
          text += fmt::format("{}kicked \"{}\" from {}", text.empty() ? "" : "\n",
                              core::printable(one.entry.name), core::printable(one.room->name()));
        expel(found,
              {std::string(protocol::code::kKicked), "the operator has ended your connection", true, {}},
              [answered, text, count = found.size()] {
                answered(done(text, [count](json::ObjectText& object) { object.integer("count", count); }));
              });
      });
}

void Moderation::mute(const Command& command, const Answered& answered) {
  const WallTime now = wall_now();
  const auto until = end_of(command, now);
  if (const auto range = address_of(command)) {
    const WallTime end = until.value_or(now + kMuteOfAddress);
    doorman_.mute({*range, end}, now);
    log_event(*log_, LogEvent::kMuted, fmt::format("admin: {} is muted {}", range->text(), until_text(end)));
    return answered(done(fmt::format("{} is muted {}", range->text(), until_text(end))));
  }
  find_called(
      command.who, command.room,
      [this, who = command.who, until, now, answered](const std::vector<Found>& found, std::string why_not) {
        if (!why_not.empty()) return answered(std::move(why_not));
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
  if (const auto range = address_of(command)) {
    if (doorman_.unmute(*range) == 0)
      return answered(refused(admin_code::kNobody, range->text() + " is not muted"));
    return answered(done(range->text() + " is muted no more"));
  }
  find_called(command.who, command.room,
              [who = command.who, answered](const std::vector<Found>& found, std::string why_not) {
                if (!why_not.empty()) return answered(std::move(why_not));
                std::size_t count = 0;
                for (const Found& one : found)
                  if (one.entry.is_muted) {
                    one.room->unmute(one.entry);
                    ++count;
                  }
                if (count == 0)
                  return answered(refused(admin_code::kNobody, fmt::format("nobody called \"{}\" is muted",
                                                                           core::printable(who))));
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
