#include "server/operator.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <cassert>
#include <chrono>
#include <utility>

#include "server/admin/answer.h"
#include "server/logging/events.h"
#include "server/version.h"
#include "shared/core/printable.h"
#include "shared/json/document.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

double as_milliseconds(Duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

/// Of those that change something.
bool has_no_other_event(Verb verb) {
  return verb == Verb::kUnmute || verb == Verb::kSay || verb == Verb::kStep || verb == Verb::kRecord;
}

}  // namespace

Operator::Operator(const Strand& strand, Lobby& lobby, const TrafficMetrics& traffic, Timekeeper& timekeeper,
                   const Metrics& metrics, Server server, std::shared_ptr<spdlog::logger> log)
    : strand_(strand),
      lobby_(lobby),
      traffic_(traffic),
      timekeeper_(timekeeper),
      metrics_(metrics),
      server_(std::move(server)),
      log_(std::move(log)),
      begun_(timekeeper.now()),
      drained_(strand) {
  assert(server_.reload && server_.stop && server_.is_stopping);
}

void Operator::carry_out(Command command, Answered answered) {
  boost::asio::post(strand_, [this, command = std::move(command), answered = std::move(answered)]() mutable {
    dispatch(command, std::move(answered));
  });
}

WebAnswer Operator::page(std::string_view path) const {
  if (path == "/healthz") return refusal(200, "ok");
  if (path == "/readyz")
    return readiness(server_.doorman.is_draining(), server_.directory.why_not_ready(timekeeper_.now()));
  if (path == "/metrics") return {200, Metrics::kContentType, metrics_.text()};
  return refusal(404, "there is no such page");
}

void Operator::dispatch(const Command& command, Answered answered) {
  if (server_.is_stopping()) return answered(refused(protocol::code::kShutdown, "the server stops"));
  if (has_no_other_event(command.verb)) {
    std::string line = encode({command, {}});
    line.pop_back();
    log_event(*log_, LogEvent::kOperator, "admin: " + line);
  }
  switch (command.verb) {
    case Verb::kStatus:
      return answered(status());
    case Verb::kRooms:
      return command.room.empty() ? answered(rooms()) : server_.people.list(command, answered);
    case Verb::kOpen:
      return server_.rooms.open(command, std::move(answered));
    case Verb::kClose:
      return server_.rooms.close(command, answered);
    case Verb::kKick:
      return server_.people.kick(command, std::move(answered));
    case Verb::kBan:
      return server_.people.ban(command, answered);
    case Verb::kUnban:
      return server_.people.unban(command, answered);
    case Verb::kBans:
      return answered(server_.people.bans());
    case Verb::kMute:
      return server_.people.mute(command, answered);
    case Verb::kUnmute:
      return server_.people.unmute(command, answered);
    case Verb::kSay:
      return answered(server_.people.say(command));
    case Verb::kPause:
      return server_.rooms.pause(command, std::move(answered));
    case Verb::kResume:
      return server_.rooms.resume(command, std::move(answered));
    case Verb::kStep:
      return server_.rooms.step(command, std::move(answered));
    case Verb::kRecord:
      return server_.rooms.record(command, std::move(answered));
    case Verb::kReload:
      return reload(answered);
    case Verb::kDrain:
      return drain(command, answered);
    case Verb::kShutdown:
      return shut_down(answered);
  }
  assert(false);  // every verb is above
}

void Operator::moderate(protocol::Moderate wish, std::string room, std::string who,
                        std::function<void(protocol::ServerMessage)> answered) {
  Command command;
  command.verb = wish.action == "kick"     ? Verb::kKick
                 : wish.action == "mute"   ? Verb::kMute
                 : wish.action == "unmute" ? Verb::kUnmute
                                           : Verb::kSay;
  command.who = std::move(wish.who);
  command.room = std::move(room);
  command.text = std::move(wish.text);
  command.seconds = wish.seconds;
  const auto refuse = [answered](const std::string& text) {
    answered(protocol::ErrorMessage{std::string(protocol::code::kNotModerated), text, false, {}});
  };
  // In his room alone: whole networks are the operator's.
  if (command.verb != Verb::kSay && command.who.empty())
    return refuse("moderate.who: a name, or the number of a louse");
  log_event(*log_, LogEvent::kModerator,
            fmt::format("moderator, {}: {} {}{}", who, wish.action, command.who, command.text));
  carry_out(std::move(command), [answered, refuse](const std::string& line) {
    const auto document = json::parse(line, {8, 1000});
    const std::string text(document->root().find("text")->text());
    if (document->root().find("type")->text() != "done") return refuse(text);
    answered(protocol::Notice{std::string(protocol::code::kModerated), text});
  });
}

std::string Operator::status() const {
  const protocol::Rooms list = lobby_.list();
  std::uint64_t players = 0, bots = 0, spectators = 0;
  for (const protocol::RoomEntry& room : list.rooms) {
    players += room.players;
    bots += room.bots;
    spectators += room.spectators;
  }
  const auto uptime = std::chrono::duration_cast<std::chrono::seconds>(timekeeper_.now() - begun_).count();
  const std::uint64_t frames = traffic_.frames_sent, bytes = traffic_.bytes_sent,
                      lines = traffic_.lines_received;
  return done(fmt::format("{}, up {} s: {} rooms, {} players, {} bots, {} spectators\n"
                          "sent {} frames, {} bytes; received {} lines\n{}",
                          kServerName, uptime, list.rooms.size(), players, bots, spectators, frames, bytes,
                          lines, metrics_.status()),
              [&](json::ObjectText& object) {
                object.text("server", kServerName).integer("uptime_s", uptime);
                object.integer("rooms", list.rooms.size()).integer("players", players);
                object.integer("bots", bots).integer("spectators", spectators);
                object.integer("frames_sent", frames).integer("bytes_sent", bytes);
                object.integer("lines_received", lines);
              });
}

std::string Operator::rooms() const {
  const auto all = lobby_.rooms();
  std::string text = fmt::format("{:<24} {:<16} {:>7} {:>5} {:>10} {:>10} {:>11} {:>8}  {}", "room", "map",
                                 "players", "bots", "spectators", "tick", "late p99 ms", "work p99", "state");
  for (const auto& room : all) {
    const protocol::RoomEntry entry = room->census();
    const auto figures = room->figures();
    text += fmt::format("\n{:<24} {:<16} {:>7} {:>5} {:>10} {:>10} {:>11.3f} {:>8.3f}  {}{}",
                        core::printable(entry.name), core::printable(entry.map), entry.players, entry.bots,
                        entry.spectators, figures->ticks, as_milliseconds(figures->lateness.quantile(0.99)),
                        as_milliseconds(figures->work.quantile(0.99)),
                        room->is_paused() ? "paused " : "runs ", room->is_recorded() ? "recorded" : "");
  }
  return done(text, [&](json::ObjectText& object) {
    object.objects("rooms", all, [](json::ObjectText& row, const auto& room) {
      const protocol::RoomEntry entry = room->census();
      const auto figures = room->figures();
      row.text("name", entry.name).text("map", entry.map).integer("players", entry.players);
      row.integer("bots", entry.bots).integer("spectators", entry.spectators);
      row.boolean("paused", room->is_paused()).boolean("recorded", room->is_recorded());
      row.integer("ticks", figures->ticks).integer("clock_moves", figures->clock_moves);
      row.number("lateness_p99_ms", as_milliseconds(figures->lateness.quantile(0.99)));
      row.number("work_p99_ms", as_milliseconds(figures->work.quantile(0.99)));
    });
  });
}

void Operator::reload(const Answered& answered) {
  server_.reload([answered](const core::Expected<std::string>& reloaded) {
    answered(reloaded ? done(*reloaded) : refused(admin_code::kFailed, reloaded.error().text()));
  });
}

void Operator::drain(const Command& command, const Answered& answered) {
  const auto seconds = static_cast<std::int64_t>(command.seconds.value_or(kDrainSeconds));
  server_.doorman.drain(wall_now() + std::chrono::seconds(seconds));
  const std::string text = fmt::format("the server stops in {} s and takes nobody any more", seconds);
  log_event(*log_, LogEvent::kDraining, "admin: drain: " + text);
  for (const auto& room : lobby_.rooms())
    room->say_from_now_on({std::string(protocol::code::kDraining), text});
  answered(done(text, [seconds](json::ObjectText& object) { object.integer("seconds", seconds); }));
  drained_.expires_after(std::chrono::seconds(seconds));
  drained_.async_wait([this](const boost::system::error_code& error) {
    if (!error) server_.stop("the server stops", "drained by its operator");
  });
}

void Operator::shut_down(const Answered& answered) {
  log_event(*log_, LogEvent::kOperator, "admin: shutdown");
  drained_.cancel();
  answered(done("the server stops"));
  server_.stop("the server stops", "shutdown by its operator");
}

}  // namespace woodlouse::server
