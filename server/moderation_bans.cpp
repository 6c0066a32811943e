// What an operator asks about who is kept out.
#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <cassert>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "server/admin/answer.h"
#include "server/logging/events.h"
#include "server/moderation.h"
#include "shared/core/printable.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
using Kind = RosterEntry::Kind;

/// As the server numbers a second one of a name: ann#2.
bool is_numbered(std::string_view name) {
  const std::string_view first = name.substr(0, name.rfind('#'));
  return first.size() != name.size() && !first.empty() && goes_by(name, first);
}

}  // namespace

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

/// Judged here: rooms and ports only say who is there.
void Moderation::enforce_bans(std::function<void(std::size_t)> done) {
  find([](const RosterEntry& entry) { return entry.kind != Kind::kHouse; }, {},
       [this, done = std::move(done)](std::vector<Found> found) {
         const Bans bans = doorman_.bans();
         const WallTime now = wall_now();
         std::map<std::string, std::vector<Found>> by_ban;  // by its text
         std::size_t count = 0;
         for (Found& one : found)
           if (const Ban* ban = bans.of(one.entry.name, now)) {
             by_ban[banned_error(*ban).text].push_back(std::move(one));
             ++count;
           }
         for (const auto& [text, meant] : by_ban)
           expel(meant, {std::string(protocol::code::kBanned), text, true, {}}, [] {});
         acceptor_.ask_addresses(
             [this, bans, now, count, done](const std::map<SessionId, std::string>& addresses) {
               std::map<std::string, std::set<SessionId>> sessions;  // by the text again
               std::size_t ended = count;
               for (const auto& [session, text] : addresses)
                 if (const auto range = AddressRange::parse(text))
                   if (const Ban* ban = bans.of(*range, now)) {
                     sessions[banned_error(*ban).text].insert(session);
                     ++ended;
                   }
               for (const auto& [text, meant] : sessions)
                 acceptor_.expel([ids = meant](SessionId id, const std::string&) { return ids.contains(id); },
                                 {std::string(protocol::code::kBanned), text, true, {}}, [](std::size_t) {});
               done(ended);
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

}  // namespace woodlouse::server
