#include "client/startup.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <cassert>
#include <chrono>
#include <csignal>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "client/config_file.h"
#include "client/local_server.h"
#include "client/name_question.h"
#include "client/opened_terminal.h"
#include "client/play/game.h"
#include "client/play/join_request.h"
#include "client/play/modes/ghost_file.h"
#include "client/play/session.h"
#include "client/play/text_game.h"
#include "client/room_list.h"
#include "client/terminal/outcome.h"
#include "client/watch_recording.h"
#include "shared/map/map_search_file.h"

namespace woodlouse::client {
namespace {

using std::chrono::steady_clock;
constexpr std::chrono::seconds kIntroduction{3};  // how long the first run's text stands without a key

int complain(int exit_code, const std::string& what, const std::string& hint) {
  std::cerr << "woodlouse: " << what << "\n";
  if (!hint.empty()) std::cerr << "      " << hint << "\n";
  return exit_code;
}

Outcome complaint(int exit_code, const core::Error& error) {
  return {exit_code, "woodlouse: " + error.where + ": " + error.what + "\n" +
                         (error.hint.empty() ? "" : "      " + error.hint + "\n")};
}

std::string describe(const Look& look) {
  const Size size = terminal_size(STDOUT_FILENO);
  const char* color = "no colour";
  if (look.color == ColorMode::k16) color = "16 colours";
  if (look.color == ColorMode::k256) color = "256 colours";
  if (look.color == ColorMode::kTruecolor) color = "true colour";
  return std::to_string(size.columns) + "x" + std::to_string(size.rows) + ", " + color + ", " +
         (look.glyphs == GlyphSet::kAscii ? "ascii" : "half blocks");
}

std::string driving_keys(const Config& config) {
  const KeyLabels keys = config.keys.labels();
  const std::string cruise = ", " + (keys.cruise == "SPC" ? "Space" : keys.cruise) + " cruise";
  if (config.steer == SteerBy::kCompass)
    return keys.up + " " + keys.left + " " + keys.down + " " + keys.right +
           " push that way (a press = 0.4 s), " + keys.brake + " brake" + cruise;
  return keys.up + " push (a press = 0.4 s), " + keys.down + " brake, " + keys.left + " " + keys.right +
         " turn" + cruise;
}

void introduce(const Config& config, const Session& session, const LocalServer& local, const Look& look) {
  const RoomView& room = session.room();
  std::cout << "woodlouse " WOODLOUSE_VERSION
               " - wood-lice on a spline hill.   (no server given: started here)\n\n"
            << "  server   listening " << session.connection().address().text() << "\n"
            << "  map      " << room.welcome()->map_name << "   3 bots\n"
            << "  page     " << local.page() << "   the same room in a browser\n";
  if (config.part == Part::kPlay)
    std::cout << "  you      \"" << config.name << "\"   change with --name or WOODLOUSE_NAME\n"
              << "  keys     " << driving_keys(config) << "\n";
  std::cout << "  screen   " << describe(look) << "   change with --color / --glyphs\n\n"
            << "  joined in " << session.join_time().count()
            << " ms.   Any key starts (or 3 s), ? for help, Q to leave.\n"
            << std::flush;
}

/// Lets the introduction stand until a key or for a while; the key. What else was typed goes with it.
std::optional<TerminalInput> await_key(boost::asio::io_context& context, KeySource& keys) {
  const auto end = steady_clock::now() + kIntroduction;
  while (keys.typed.empty() && steady_clock::now() < end) {
    pollfd key{keys.fd, POLLIN, 0};
    if (poll(&key, 1, 20) > 0) {
      std::array<char, 256> typed{};
      const ssize_t size = read(keys.fd, typed.data(), typed.size());
      if (size <= 0) return Key{.character = U'q'};  // hung up
      keys.keyboard.feed({typed.data(), static_cast<std::size_t>(size)}, steady_clock::now(), keys.typed);
      std::erase_if(keys.typed,
                    [](const TerminalInput& input) { return !std::holds_alternative<Key>(input); });
    }
    keys.keyboard.expire(steady_clock::now(), keys.typed);
    context.restart();
    context.poll();
  }
  const auto typed = std::exchange(keys.typed, {});
  return typed.empty() ? std::nullopt : std::optional(typed.front());
}

/// Where things are remembered; empty: nowhere.
std::filesystem::path data_of(const Config& config) {
  return config.no_files ? std::filesystem::path() : data_folder();
}

Outcome play(boost::asio::io_context& context, Session& session, const Config& config, LocalServer* local,
             OpenedTerminal& terminal) {
  Look look = terminal.choose(config.color, config.glyphs);
  look.palette = config.palette;
  GameSettings settings{look,        config.view,  config.fps,  Overlay::kNone,
                        config.keys, config.steer, config.bell, data_of(config)};
  if (local != nullptr) {
    introduce(config, session, *local, look);
    const auto first = await_key(context, terminal.keys());
    const Key* const key = first ? std::get_if<Key>(&*first) : nullptr;
    if (key != nullptr && is_leaving(*key, config.keys)) return {};
    if (key != nullptr && picture_action(*key, config.keys) == Action::kHelp) settings.first = Overlay::kHelp;
    settings.begun_by_itself = key == nullptr;
  }
  TerminalGuard& guard = terminal.fill_screen();
  TerminalScreen screen = terminal.screen();
  Game game(context, session, guard, terminal.take_keys(), screen, settings,
            local != nullptr ? [local] { return local->alive(); } : std::function<bool()>());
  return game.run();
}

/// A state that was not what the server said outweighs how the run ended otherwise.
Outcome judged(Outcome outcome, const RoomView& room) {
  const auto& of_key = room.verifier().difference();
  const auto& of_tick = room.follower().difference();
  if (!of_key && !of_tick) return outcome;
  return {kExitDiffers, outcome.message + "woodlouse: " + (of_key ? to_text(*of_key) : to_text(*of_tick)) +
                            "\n      the server, or something on the way here, altered the state\n"};
}

bool write_line(const std::string& line) {
  std::cout << line << "\n" << std::flush;
  return static_cast<bool>(std::cout);
}

Outcome tell(boost::asio::io_context& context, Session& session, const Config& config, LocalServer* local) {
  const TextGame::Manner manner{config.keys, config.steer, isatty(STDIN_FILENO) == 0 ? "" : data_of(config)};
  const auto alive = local != nullptr ? [local] { return local->alive(); } : std::function<bool()>();
  write_line("joined " + session.connection().address().text() + ", map " +
             session.room().welcome()->map_name);
  if (isatty(STDIN_FILENO) == 0) return TextGame(context, session, -1, write_line, manner, alive).run();
  auto keys = open_terminal_for_keys(STDIN_FILENO);
  if (!keys) return {kExitIo, "woodlouse: " + keys.error().text() + "\n"};
  const Descriptor modes(dup(*keys));
  auto guard = TerminalGuard::enter(modes.get(), STDOUT_FILENO, TerminalUse::kKeysOnly);
  return TextGame(context, session, *keys, write_line, manner, alive).run();
}

/// Asks for the name, and keeps it for the next time where files may be written.
void name_louse(Config& config) {
  const auto name = ask_for_name(config.name, std::cin, std::cout);
  if (!name) return;
  config.name = *name;
  if (config.no_files) return;
  const auto kept = remember_name(config_file(), *name);
  if (!kept) std::cerr << "woodlouse: the name is not kept: " << kept.error().text() << "\n";
}

/// A server if one is to be started here, the game on it, and its end. terminal: none, where it is told in
/// lines.
Outcome join_and_play(const Config& config, std::unique_ptr<OpenedTerminal> terminal) {
  std::unique_ptr<LocalServer> local;
  if (!config.server) {
    const auto map = map::find_map(config.map);
    if (!map) return complaint(kExitUsage, map.error());
    auto started = LocalServer::start({.map = *map});
    if (!started) return complaint(kExitUnreachable, started.error());
    local = std::move(*started);
  }
  boost::asio::io_context context(1);
  const protocol::Role role =
      config.part == Part::kWatch ? protocol::Role::kSpectator : protocol::Role::kPlayer;
  protocol::Join join = make_join(role, config.name, config.room, config.hashes);
  if (role == protocol::Role::kSpectator && config.hashes == Hashes::kIgnored) join = by_inputs(join);
  join.token = config.token;
  Session session(context, local ? local->address() : *config.server, join);
  if (!data_of(config).empty()) session.room().own_game().ghosts().keep_in(data_of(config));
  if (const auto joined = session.join(); !joined) return complaint(kExitUnreachable, joined.error());
  const Outcome outcome = terminal == nullptr ? tell(context, session, config, local.get())
                                              : play(context, session, config, local.get(), *terminal);
  terminal.reset();  // given back before the server hears of it
  session.leave();
  return judged(outcome, session.room());
}

}  // namespace

int run_client(const Config& given) {
  Config config = given;
  assert(!config.no_files || (config.server && config.part != Part::kReplay));
  if (config.part == Part::kRooms) {
    const auto rooms = ask_for_rooms(*config.server);
    if (!rooms)
      return complain(kExitUnreachable, rooms.error().where + ": " + rooms.error().what, rooms.error().hint);
    std::cout << table_of(*rooms);
    return kExitFine;
  }
  const bool as_text = config.glyphs == GlyphChoice::kText;
  if (config.part == Part::kReplay && (as_text || isatty(STDOUT_FILENO) == 0)) {
    return complain(
        kExitUsage,
        "a recording is watched on a terminal. For scripts use:  woodlouse-server verify " + config.recording,
        "");
  }
  if (!as_text && isatty(STDOUT_FILENO) == 0) {
    return complain(kExitUsage, "stdout is not a terminal. For scripts use:  woodlouse --watch --glyphs text",
                    "");
  }
  if (!as_text && hints_of_environment().term == "dumb") {
    return complain(kExitUsage, "this terminal can't place its cursor (TERM=dumb)",
                    "try:  woodlouse --glyphs text");
  }
  std::signal(SIGPIPE, SIG_IGN);  // a pipe nobody reads is an error of write()
  if (config.part == Part::kReplay) {
    const Outcome outcome = watch_recording(config);
    std::cerr << outcome.message;
    return outcome.exit_code;
  }
  if (config.asks_name && config.part == Part::kPlay && !as_text && isatty(STDIN_FILENO) != 0)
    name_louse(config);
  std::unique_ptr<OpenedTerminal> terminal;
  if (!as_text) {  // asked before the server is, so that it answers meanwhile
    auto opened = OpenedTerminal::open();
    if (!opened)
      return complain(kExitIo, opened.error().where + ": " + opened.error().what, opened.error().hint);
    terminal = std::move(*opened);
  }
  const Outcome outcome = join_and_play(config, std::move(terminal));
  std::cerr << outcome.message;
  return outcome.exit_code;
}

}  // namespace woodlouse::client
