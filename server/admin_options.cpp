#include "server/admin_options.h"

#include <CLI/CLI.hpp>

#include <utility>

#include "server/option_checks.h"
#include "shared/core/joined.h"

namespace woodlouse::server {

namespace {

constexpr const char* kAdminExamples =
    R"(The server must have been started with --admin. The answer goes to standard
output, a refusal to standard error.

Examples:
  woodlouse-server admin status
  woodlouse-server admin open maps/hills.json --name evening
  woodlouse-server admin ban 192.0.2.7 --for 1h
  woodlouse-server admin --socket /run/woodlouse/admin.sock drain 60
  woodlouse-server admin --connect 127.0.0.1:7779 --token-file token rooms --json

Exit: 0 done; 1 the server refuses; 2 usage; 3 no server there, or no answer.)";

/// Digits alone are seconds.
core::Expected<std::uint64_t> seconds_of(const std::string& option, std::string text, bool may_be_none) {
  const bool is_bare = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (is_bare) text += 's';
  const auto duration = parse_duration(option, text, std::chrono::seconds(may_be_none ? 0 : 1));
  if (!duration) return tl::unexpected(duration.error());
  return static_cast<std::uint64_t>(duration->count());
}

CLI::App* add_verb(CLI::App& admin, TypedErrand& typed, Verb verb, const std::string& what) {
  CLI::App* command = admin.add_subcommand(std::string(to_text(verb)), what);
  command->fallthrough();
  command->footer(std::string());
  command->final_callback([&typed, verb] { typed.command.verb = verb; });
  return command;
}

void add_who(CLI::App* command, TypedErrand& typed, const std::string& what) {
  command->add_option("who", typed.command.who, what)->required();
}

void add_where(CLI::App* command, TypedErrand& typed, const std::string& name) {
  command->add_option(name, typed.command.room, "Of that room alone; left out, of all");
}

void add_people_verbs(CLI::App& admin, TypedErrand& typed) {
  CLI::App* kick = add_verb(admin, typed, Verb::kKick, "End the connection of a player or spectator");
  add_who(kick, typed, "A name, or the number of a louse");
  add_where(kick, typed, "--room");
  CLI::App* ban = add_verb(admin, typed, Verb::kBan, "Keep out an address, a network or a name");
  add_who(ban, typed, "192.0.2.7, 192.0.2.0/24, 2001:db8::/48, or a name");
  ban->add_option("--for", typed.how_long, "90s, 10m, 1h, 7d; left out, for good");
  add_who(add_verb(admin, typed, Verb::kUnban, "Let it in again"), typed, "As `bans` shows it");
  add_verb(admin, typed, Verb::kBans, "Who is kept out, and until when");
  CLI::App* mute = add_verb(admin, typed, Verb::kMute, "Drop somebody's chat");
  add_who(mute, typed, "A name, the number of a louse, or an address (for 1h, where nothing is said)");
  mute->add_option("--for", typed.how_long, "90s, 10m, 1h; left out, as long as the connection lasts");
  add_where(mute, typed, "--room");
  CLI::App* unmute = add_verb(admin, typed, Verb::kUnmute, "Let somebody chat again");
  add_who(unmute, typed, "As it was muted");
  add_where(unmute, typed, "--room");
  CLI::App* say = add_verb(admin, typed, Verb::kSay, "Tell all something");
  say->add_option("text", typed.words, "What")->required();
  add_where(say, typed, "--room");
}

void add_room_verbs(CLI::App& admin, TypedErrand& typed) {
  CLI::App* open = add_verb(admin, typed, Verb::kOpen, "Open a room, or one for each mode of a map");
  open->add_option("file", typed.command.file, "Map file, as the server finds it, or a shipped map's name")
      ->required();
  open->add_option("--name", typed.command.name, "Of the room; left out, the map's");
  add_verb(admin, typed, Verb::kClose, "Close a room; who is in it is told, its recording ends")
      ->add_option("room", typed.command.room, "Which")
      ->required();
  add_where(add_verb(admin, typed, Verb::kPause, "Let no tick pass"), typed, "room");
  add_where(add_verb(admin, typed, Verb::kResume, "Go on"), typed, "room");
  CLI::App* step = add_verb(admin, typed, Verb::kStep, "Let a paused room go on for some ticks");
  step->add_option("ticks", typed.command.ticks, "How many")->required()->check(whole_number(1, kMostSteps));
  add_where(step, typed, "room");
  CLI::App* record = add_verb(admin, typed, Verb::kRecord, "Begin or end a recording (by --record's name)");
  record->add_option("on", typed.on_or_off, "on or off")->required()->check(CLI::IsMember({"on", "off"}));
  add_where(record, typed, "room");
}

}  // namespace

CLI::App* add_admin_command(CLI::App& app, TypedErrand& typed) {
  CLI::App* admin = app.add_subcommand("admin", "Command a running server");
  typed.socket = default_admin_socket().string();
  CLI::Option* socket = admin->add_option("--socket", typed.socket, "The server's --admin PATH")
                            ->envname("WOODLOUSE_ADMIN_SOCKET")
                            ->capture_default_str();
  CLI::Option* connect =
      admin->add_option("--connect", typed.connect, "The server's --admin HOST:PORT")->excludes(socket);
  admin->add_option("--token-file", typed.token_file, "The server's --admin-token-file")->needs(connect);
  admin->add_flag("--json", typed.as_json, "The answer as a JSON line");
  add_verb(*admin, typed, Verb::kStatus, "How the server is");
  add_verb(*admin, typed, Verb::kRooms, "Which rooms there are and how they keep time; of one, who is in it")
      ->add_option("room", typed.command.room, "Which");
  add_room_verbs(*admin, typed);
  add_people_verbs(*admin, typed);
  add_verb(*admin, typed, Verb::kReload, "Read limits, log level, certificate and bans again, as SIGHUP");
  add_verb(*admin, typed, Verb::kDrain, "Take nobody any more, and stop after a while")
      ->add_option("seconds", typed.how_long, "When; left out, 60");
  add_verb(*admin, typed, Verb::kShutdown, "Stop now: everybody is told, all is written");
  admin->require_subcommand(1, 1);
  admin->footer(kAdminExamples);
  return admin;
}

core::Expected<AdminErrand> checked_errand(const TypedErrand& typed) {
  AdminErrand errand;
  const char* const option = typed.connect ? "--connect" : "--socket";
  auto where = parse_admin_address(typed.connect.value_or(typed.socket), option);
  if (!where) return tl::unexpected(where.error());
  if (typed.connect.has_value() != std::holds_alternative<ListenAddress>(*where))
    return core::fail(core::joined({option, " ", typed.connect.value_or(typed.socket)}),
                      typed.connect ? "is a socket's path" : "is no socket's path",
                      typed.connect ? "say  --socket PATH" : "say  --connect HOST:PORT");
  errand.where = std::move(*where);
  errand.token_file = typed.token_file;
  errand.as_json = typed.as_json;
  errand.command = typed.command;
  for (const std::string& word : typed.words)
    errand.command.text += (errand.command.text.empty() ? "" : " ") + word;
  errand.command.on = typed.on_or_off == "on";
  if (!typed.how_long) return errand;
  const bool drains = typed.command.verb == Verb::kDrain;
  const auto seconds = seconds_of(drains ? "drain" : "--for", *typed.how_long, drains);
  if (!seconds) return tl::unexpected(seconds.error());
  errand.command.seconds = *seconds;
  return errand;
}

void add_admin_options(CLI::App& app, TypedAdmin& typed) {
  app.add_option(
         "--admin", typed.where,
         "The operator's door: PATH of a Unix socket, or HOST:PORT on this machine; printed as `admin "
         "PATH`. `default`: $XDG_RUNTIME_DIR/woodlouse.sock. Left out: there is none")
      ->envname("WOODLOUSE_ADMIN");
  app.add_option("--admin-token-file", typed.token_file,
                 "File of the token that --admin HOST:PORT asks for: one line of 8 to 256 characters")
      ->envname("WOODLOUSE_ADMIN_TOKEN_FILE");
}

void add_password_options(CLI::App& app, std::optional<std::filesystem::path>& file, bool& may_be_plain) {
  CLI::Option* passwords =
      app.add_option(
             "--password-file", file,
             "Who joins needs a token of this file: lines of `player TOKEN`, `moderator TOKEN` or `admin "
             "TOKEN`; read again at SIGHUP")
          ->envname("WOODLOUSE_PASSWORD_FILE");
  app.add_flag("--plain-passwords", may_be_plain,
               "Take tokens without TLS from other machines, too, where others may read them")
      ->envname("WOODLOUSE_PLAIN_PASSWORDS")
      ->needs(passwords);
}

void add_ban_option(CLI::App& app, std::optional<std::filesystem::path>& file) {
  app.add_option(
         "--ban-file", file,
         "Who is kept out, by address or name; read at the start and at SIGHUP, written when the operator "
         "bans somebody. Left out, bans last as long as the server")
      ->envname("WOODLOUSE_BAN_FILE");
}

core::Expected<std::optional<AdminSettings>> checked_admin(const TypedAdmin& typed) {
  if (!typed.where) {
    if (!typed.token_file) return std::nullopt;
    return core::fail("--admin-token-file", "there is no door that asks for it",
                      "say where:  --admin 127.0.0.1:7779");
  }
  auto where = *typed.where == "default" ? core::Expected<AdminAddress>(default_admin_socket())
                                         : parse_admin_address(*typed.where, "--admin");
  if (!where) return tl::unexpected(where.error());
  const bool is_port = std::holds_alternative<ListenAddress>(*where);
  if (is_port && !typed.token_file)
    return core::fail("--admin " + *typed.where, "whoever is on this machine could command the server",
                      "--admin-token-file FILE, or a Unix socket, which its mode guards:  --admin PATH");
  if (!is_port && typed.token_file)
    return core::fail("--admin-token-file", "a Unix socket is guarded by its mode and asks for no token",
                      "leave it out");
  return AdminSettings{std::move(*where), typed.token_file};
}

}  // namespace woodlouse::server
