#include "client/config.h"

#include <pwd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "client/config_file.h"
#include "client/option_words.h"
#include "shared/core/whole_file.h"
#include "shared/json/document.h"
#include "shared/protocol/messages.h"
#include "shared/protocol/text_cleaning.h"

namespace woodlouse::client {
namespace {

constexpr std::string_view kVersion = "woodlouse " WOODLOUSE_VERSION;
constexpr int kUsage = 2;

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

/// Everything as it is written, before it is understood.
struct Raw {
  std::string server, map, name, room, recording, maps, color, glyphs, palette, view, steer, token,
      password_file;
  KeyMap keys{};
  int fps = 30;
  bool watch = false;
  bool rooms = false;
  bool verify = false;
  bool no_files = false;
  bool bell = false;
  bool asks_name = false;
};

constexpr std::string_view kNoFiles = "--no-files";

/// Asked before anything is read: a config file could not be unread.
bool wants_no_files(int argc, const char* const* argv) {
  return !environment("WOODLOUSE_NO_FILES").empty() ||
         std::any_of(argv, argv + argc, [](const char* argument) { return kNoFiles == argument; });
}

Raw raw_of(const Config& config) {
  return {.server = config.server ? config.server->text() : "",
          .map = config.map,
          .name = config.name,
          .room = config.room,
          .recording = config.recording,
          .maps = config.maps,
          .color = color_words().word(config.color),
          .glyphs = glyph_words().word(config.glyphs),
          .palette = palette_words().word(config.palette),
          .view = view_words().word(config.view),
          .steer = steer_words().word(config.steer),
          .token = config.token,
          .password_file = "",
          .keys = config.keys,
          .fps = config.fps,
          .watch = config.part == Part::kWatch,
          .rooms = config.part == Part::kRooms,
          .verify = config.hashes == Hashes::kVerified,
          .no_files = config.no_files,
          .bell = config.bell,
          .asks_name = config.asks_name};
}

/// As typed, or the first line of the file, which no list of processes shows.
core::Expected<std::string> token_of(const Raw& raw) {
  if (raw.password_file.empty()) return raw.token;
  auto text = core::read_whole_file(raw.password_file, protocol::kMaxPasswordBytes + 2);
  if (!text) return core::fail("password-file " + raw.password_file, text.error().what, text.error().hint);
  return text->substr(0, text->find_first_of("\r\n"));
}

/// HOST:PORT of HOST:PORT/ROOM; what is a link stays whole, to be refused as one.
std::string without_room(const std::string& server) {
  return server.find("://") != std::string::npos ? server : server.substr(0, server.find('/'));
}

/// The room of HOST:PORT/ROOM, whose name may have more of them; empty: none.
std::string room_of(const std::string& server) {
  const std::size_t slash = server.find('/');
  return slash == std::string::npos ? std::string() : server.substr(slash + 1);
}

core::Expected<Config> understood(const Raw& raw) {
  Config config;
  if (!raw.server.empty()) {
    auto address = parse_address(without_room(raw.server));
    if (!address)
      return core::fail("server", address.error().where + ": " + address.error().what, address.error().hint);
    config.server = std::move(*address);
  }
  const auto color = color_words().find(raw.color);
  if (!color) return core::fail("color", "\"" + raw.color + "\" is none", "one of " + color_words().list());
  const auto glyphs = glyph_words().find(raw.glyphs);
  if (!glyphs)
    return core::fail("glyphs", "\"" + raw.glyphs + "\" is none", "one of " + glyph_words().list());
  const auto palette = palette_words().find(raw.palette);
  if (!palette)
    return core::fail("palette", "\"" + raw.palette + "\" is none", "one of " + palette_words().list());
  const auto view = view_words().find(raw.view);
  if (!view) return core::fail("view", "\"" + raw.view + "\" is none", "one of " + view_words().list());
  const auto steer = steer_words().find(raw.steer);
  if (!steer) return core::fail("steer", "\"" + raw.steer + "\" is none", "one of " + steer_words().list());
  if (raw.fps < 5 || raw.fps > 60) return core::fail("fps", std::to_string(raw.fps) + " is not from 5 to 60");
  if (raw.name.empty() || raw.name.size() > protocol::kMaxNameBytes) {
    return core::fail("name", "it has " + std::to_string(raw.name.size()) + " bytes",
                      "from 1 to 24 bytes of UTF-8");
  }
  if (raw.rooms && (raw.server.empty() || !raw.recording.empty()))
    return core::fail("rooms", "no server is named", "woodlouse --rooms HOST:PORT");
  if (raw.no_files && !raw.recording.empty())
    return core::fail("replay", "a recording is a file, and --no-files forbids all of them");
  config.no_files = raw.no_files;
  config.map = raw.map;
  config.name = raw.name;
  config.room = room_of(raw.server).empty() ? raw.room : room_of(raw.server);
  config.bell = raw.bell;
  config.asks_name = raw.asks_name;
  auto token = token_of(raw);
  if (!token) return tl::unexpected(token.error());
  config.token = std::move(*token);
  config.part = !raw.recording.empty() ? Part::kReplay : raw.watch ? Part::kWatch : Part::kPlay;
  if (raw.rooms) config.part = Part::kRooms;
  config.recording = raw.recording;
  config.maps = raw.maps;
  config.hashes = raw.verify ? Hashes::kVerified : Hashes::kIgnored;
  config.color = *color;
  config.glyphs = *glyphs;
  config.palette = *palette;
  config.view = *view;
  config.steer = *steer;
  config.keys = raw.keys;
  config.fps = raw.fps;
  return config;
}

std::string default_name() {
  std::string name = environment("USER");
  if (const passwd* const account = getpwuid(getuid()); name.empty() && account != nullptr)
    name = account->pw_name;
  name = protocol::clean_text(name, protocol::kMaxNameBytes);
  return name.empty() ? "louse" : name;
}

/// The defaults: the program's, then the config file's.
core::Expected<Config> defaults(bool no_files) {
  Config config;
  config.no_files = no_files;
  config.asks_name = true;
  config.name = no_files ? std::string("louse") : default_name();  // the account's name is nobody's
  if (no_files) return config;
  const std::filesystem::path file = config_file();
  std::error_code error;
  if (file.empty() || !std::filesystem::exists(file, error)) return config;
  constexpr std::size_t kMaxBytes = 1u << 20;
  const auto text = core::read_whole_file(file, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  return read_config_file(*text, file.string(), config);
}

Parsed mistake(const core::Error& error) {
  Parsed parsed;
  parsed.exit_code = kUsage;
  parsed.output = "woodlouse: " + error.where + ": " + error.what + "\n      " +
                  (error.hint.empty() ? "see:  woodlouse --help" : error.hint) + "\n";
  return parsed;
}

void add_options(CLI::App& app, Raw& raw) {
  app.add_option("server", raw.server, "HOST:PORT or HOST:PORT/ROOM; without it a server is started here")
      ->envname("WOODLOUSE_SERVER");
  app.add_option("--map", raw.map, "map of the server started here: a file, or a name")
      ->envname("WOODLOUSE_MAP")
      ->capture_default_str();
  app.add_option("--name", raw.name, "your name, at most 24 bytes")
      ->envname("WOODLOUSE_NAME")
      ->capture_default_str();
  app.add_option("--room", raw.room, "room of the server, or its code; default: its first")
      ->envname("WOODLOUSE_ROOM");
  app.add_flag("--rooms", raw.rooms, "only list the rooms of the server and its cluster");
  app.add_option("--token", raw.token, "password of the server; others may see it in a list of processes")
      ->envname("WOODLOUSE_TOKEN");
  app.add_option("--password-file", raw.password_file, "file whose first line is that password")
      ->envname("WOODLOUSE_TOKEN_FILE");
  app.add_flag("--watch,!--play", raw.watch, "watch, without a louse of your own")
      ->envname("WOODLOUSE_WATCH");
  app.add_flag("--verify,!--no-verify", raw.verify,
               "recompute the state hash of every key; exit 1 when one differs")
      ->envname("WOODLOUSE_VERIFY");
  app.add_option("--color", raw.color, color_words().list())
      ->envname("WOODLOUSE_COLOR")
      ->capture_default_str();
  app.add_option("--glyphs", raw.glyphs,
                 glyph_words().list() + "; text: lines, for a screen reader or a pipe")
      ->envname("WOODLOUSE_GLYPHS")
      ->capture_default_str();
  app.add_option("--palette", raw.palette,
                 palette_words().list() +
                     ": colours of lice for eyes that see red and green, or blue and green, alike")
      ->envname("WOODLOUSE_PALETTE")
      ->capture_default_str();
  app.add_option("--view", raw.view, view_words().list())->envname("WOODLOUSE_VIEW")->capture_default_str();
  app.add_option("--steer", raw.steer,
                 steer_words().list() + "; compass: the keys push that way in the picture")
      ->envname("WOODLOUSE_STEER")
      ->capture_default_str();
  app.add_flag(std::string(kNoFiles), raw.no_files,
               "read and write no file of the account's: no config file, no recording, no server of its own; "
               "for who plays through ssh")
      ->envname("WOODLOUSE_NO_FILES");
  app.add_flag("--bell,!--no-bell", raw.bell,
               "ring the terminal's bell when you fall, hold the place, end a run or drive a record")
      ->envname("WOODLOUSE_BELL");
  app.add_option("--fps", raw.fps, "frames a second, 5..60")->envname("WOODLOUSE_FPS")->capture_default_str();
  CLI::App* const replay =
      app.add_subcommand("replay", "watch a recording: play, pause, jump, follow; ? shows the keys");
  replay->add_option("FILE", raw.recording, "what woodlouse-server --record wrote; .zst too")->required();
  replay->add_option("--maps", raw.maps,
                     "folder of the map, where the recording only names it and it is not beside it");
  replay->footer(
      "For example:  woodlouse replay game.ndjson\n"
      "Keys: Space play/pause, < > 5 s, comma and full stop one tick, [ ] speed, 0-9 jump, F Shift-F "
      "follow,\n"
      "      N Shift-N events, V view, Tab scores, ? help, Q quit.\n"
      "Options of woodlouse (--color, --glyphs, --palette, --view, --fps) may stand here, too.\n"
      "Exit: 0 fine, 1 a tick's re-run differs, 2 usage, 74 no such recording or terminal lost, 130 Ctrl-C.");
  replay->fallthrough();
}

}  // namespace

core::Expected<Config> read_config_file(const std::string& text, const std::string& file, Config config) {
  const auto document = json::parse_file(text, file, {4, 1000});
  if (!document) return tl::unexpected(document.error());
  if (!document->root().is(json::Kind::kObject))
    return core::fail(file, "it is not a JSON object", "for example {\"name\": \"mara\"}");
  Raw raw = raw_of(config);
  const std::initializer_list<std::pair<const char*, std::string*>> texts = {
      {"server", &raw.server},   {"map", &raw.map},     {"name", &raw.name},
      {"room", &raw.room},       {"color", &raw.color}, {"glyphs", &raw.glyphs},
      {"palette", &raw.palette}, {"view", &raw.view},   {"steer", &raw.steer}};
  const auto place_of = [&file](const json::Value& value) {
    return file + ":" + std::to_string(value.line()) + ": " + std::string(value.key());
  };
  for (const json::Value& value : document->root().children()) {
    const std::string key(value.key());
    const std::string where = place_of(value);
    const auto* const known =
        std::find_if(texts.begin(), texts.end(), [&key](const auto& t) { return key == t.first; });
    if (known != texts.end()) {
      if (!value.is(json::Kind::kString)) return core::fail(where, "it is not a string");
      *known->second = value.text();
      if (key == "name") raw.asks_name = false;
    } else if (key == "fps") {
      const auto fps = value.integer();
      if (!fps) return core::fail(where, "it is not a whole number");
      raw.fps = static_cast<int>(std::clamp<std::int64_t>(*fps, -1, 1000));
    } else if (key == "watch" || key == "verify" || key == "bell") {
      if (!value.is(json::Kind::kBoolean)) return core::fail(where, "it is not true or false");
      (key == "watch" ? raw.watch : key == "verify" ? raw.verify : raw.bell) = value.boolean();
    } else if (key == "keys") {
      auto keys = keys_of(value);
      if (!keys) {
        const std::string part = keys.error().where.empty() ? "" : "." + keys.error().where;
        return core::fail(where + part, keys.error().what, keys.error().hint);
      }
      raw.keys = std::move(*keys);
    } else {
      return core::fail(
          where, "no such setting",
          "known: server map name room color glyphs palette view steer keys fps watch verify bell");
    }
  }
  auto result = understood(raw);
  if (result) return result;
  const auto field = document->root().find(result.error().where);
  return core::fail(field ? place_of(*field) : file + ": " + result.error().where, result.error().what,
                    result.error().hint);
}

Parsed parse_arguments(int argc, const char* const* argv) {
  assert(argc >= 1 && argv != nullptr);
  const bool no_files = wants_no_files(argc, argv);
  const auto base = defaults(no_files);
  Raw raw = raw_of(base.value_or(Config()));  // --help and --version do without a file that is wrong
  CLI::App app("Wood-lice on a spline hill: the terminal client.", "woodlouse");
  app.set_version_flag("--version", std::string(kVersion));
  app.footer(
      "Watch a recording:  woodlouse replay game.ndjson\n"
      "Keys: W A S D push that way, X brake, Space cruise, T chat, Tab scores, V view, ? help, Q quit.\n"
      "Exit: 0 fine, 1 a verified state differs, 2 usage, 69 server unreachable, 74 terminal lost, 130 "
      "Ctrl-C.");
  add_options(app, raw);
  Parsed parsed;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {  // of which the end by --help and --version is one
    // Asked for, whatever else is wrong: a variable of the environment is read before.
    const auto is_asked = [](const CLI::App& one) { return one.get_help_ptr()->count() > 0; };
    const bool wants_help = is_asked(app) || is_asked(*app.get_subcommand("replay"));
    if (!wants_help && app.get_version_ptr()->count() == 0) return mistake({"arguments", error.what(), ""});
    parsed.exit_code = 0;
    parsed.output = wants_help ? app.help() : std::string(kVersion) + "\n";
    return parsed;
  }
  if (!base) return mistake(base.error());
  raw.no_files = raw.no_files || no_files;  // once asked for it stays
  raw.asks_name = raw.asks_name && app.get_option("--name")->count() == 0;
  const std::string room = room_of(raw.server);
  if (!room.empty() && app.get_option("--room")->count() > 0 && raw.room != room)
    return mistake({"room", "the address names " + room + ", --room names " + raw.room, "name one of them"});
  auto config = understood(raw);
  if (!config) return mistake(config.error());
  if (config->no_files && !config->server)
    return mistake(
        {"server", "none is named, and --no-files starts none here", "woodlouse --no-files HOST:PORT"});
  parsed.config = std::move(*config);
  return parsed;
}

}  // namespace woodlouse::client
