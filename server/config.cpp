#include "server/config.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "server/admin_options.h"
#include "server/cluster_options.h"
#include "server/config_file.h"
#include "server/file_options.h"
#include "server/limit_options.h"
#include "server/option_checks.h"
#include "server/record_options.h"
#include "server/records_options.h"
#include "server/version.h"
#include "server/web_options.h"
#include "shared/core/thread_team.h"

namespace woodlouse::server {
namespace {

constexpr std::uint64_t kMaxTickHz = 1000;
constexpr std::uint64_t kMaxBots = 1000;
constexpr std::uint64_t kMostRounds = 1000;

constexpr const char* kExamples = R"(Examples:
  woodlouse-server --map maps/volcano.json --bots 3 --record game.ndjson --shadow
  woodlouse-server --map volcano hills --record /var/games/ --record-every 1h --record-keep 10G
  woodlouse-server --map volcano --mode race --records records/
  woodlouse-server verify game.ndjson
  woodlouse-server records verify records/
  woodlouse-server fork game.ndjson --tick 1200 --listen :7778
  woodlouse-server make-map S37E174.hgt --modes --out my_hill.json

Exit: 0 fine; 1 a recording or a record that differs or is not whole, or what
can't be read or served; 2 usage.)";

constexpr const char* kForkExamples =
    R"(Its lice go on as they were; with --adopt-by-name who joins under a recorded name
takes that louse over. Map, tick rate and seed are the recording's.

Examples:
  woodlouse-server fork game.ndjson --tick 1200 --adopt-by-name --listen :7778
  woodlouse-server fork game.ndjson.zst --tick 1200 --bots 4 --record other-end.ndjson.zst)";

/// The options of a server as typed, before they are checked against each other.
struct TypedServe {
  ServeConfig serve;
  std::string listen = "127.0.0.1:7777";
  std::string bots_skill{bots::to_text(bots::Skill::kFair)};
  std::string bots_alone = "stand";
  std::string mode = "all";
  std::string log_format = "text";
  TypedRecord record;
  TypedWeb web;
  std::vector<std::string> trusted_proxies;
  TypedAdmin admin;
  TypedCluster cluster;
  std::string config_file;
};

struct Typed {
  TypedServe serve;
  TypedServe fork;
  ForkPoint fork_point;
  CheckConfig check;
  MakeMapConfig make_map;
  VerifyConfig verify;
  InspectConfig inspect;
  RecordsConfig records;
  TypedErrand errand;
  TypedClusterErrand cluster;
};

/// Which games; a fork takes all of it from its recording.
void add_game_options(CLI::App& app, TypedServe& typed) {
  ServeConfig& serve = typed.serve;
  app.add_option("--map", serve.maps,
                 "Map file, or the name of one that came with this; several make as many rooms, at most " +
                     std::to_string(kMaxRooms))
      ->envname("WOODLOUSE_MAP");
  app.add_option("--tick-hz", serve.tick_hz, "Steps a second")
      ->envname("WOODLOUSE_TICK_HZ")
      ->check(whole_number(1, kMaxTickHz))
      ->capture_default_str();
  app.add_option("--seed", serve.seed, "Seed of spawns and bots; another one each time when left out")
      ->envname("WOODLOUSE_SEED")
      ->check(whole_number(0));
  app.add_option(
         "--mode", typed.mode,
         "What is played: one mode, or all that a map has, each in a room of its own (volcano, volcano/race)")
      ->envname("WOODLOUSE_MODE")
      ->check(CLI::IsMember({"all", "roam", "race", "forage", "hill"}))
      ->capture_default_str();
  app.add_option(
         "--rotate", serve.rotate,
         "One room, `rotation`, for all of them: each is played for so many rounds (of 5 minutes where there "
         "are no rules), or until most players vote to skip it")
      ->envname("WOODLOUSE_ROTATE")
      ->check(whole_number(1, kMostRounds));
}

void add_serve_options(CLI::App& app, TypedServe& typed) {
  ServeConfig& serve = typed.serve;
  app.add_option("--listen", typed.listen,
                 "HOST:PORT; port 0 picks a free one, printed as `listening HOST:PORT`")
      ->envname("WOODLOUSE_LISTEN")
      ->capture_default_str();
  add_web_options(app, typed.web);
  app.add_option("--trusted-proxy", typed.trusted_proxies,
                 "ADDRESS[/PREFIX] of a proxy that says for whom a connection is: by the PROXY protocol, "
                 "version 2, on both ports, or by X-Forwarded-For on that of --web; several may be given")
      ->envname("WOODLOUSE_TRUSTED_PROXY");
  add_admin_options(app, typed.admin);
  add_ban_option(app, serve.ban_file);
  add_password_options(app, serve.password_file, serve.may_passwords_be_plain);
  app.add_option("--state-hz", serve.state_hz, "Frames a second; divides the tick rate")
      ->envname("WOODLOUSE_STATE_HZ")
      ->check(whole_number(1, kMaxTickHz))
      ->capture_default_str();
  add_record_options(app, typed.record);
  add_records_option(app, serve.records);
  add_cluster_options(app, typed.cluster);
  app.add_flag("--shadow", serve.shadow,
               "Re-run every tick beside the game and compare; a difference is logged and kept")
      ->envname("WOODLOUSE_SHADOW");
  app.add_option("--ticks", serve.ticks, "Stop after so many ticks")
      ->envname("WOODLOUSE_TICKS")
      ->check(whole_number(1));
  app.add_option("--bots", serve.bots, "The house's own bots, in every room")
      ->envname("WOODLOUSE_BOTS")
      ->check(whole_number(0, kMaxBots))
      ->capture_default_str();
  app.add_option("--bots-skill", typed.bots_skill, "How well they play by a room's rules")
      ->envname("WOODLOUSE_BOTS_SKILL")
      ->check(CLI::IsMember({"easy", "fair", "hard"}))
      ->capture_default_str();
  app.add_option("--bots-alone", typed.bots_alone,
                 "What they do while nobody is there: play, or stand still with the room after 10 s")
      ->envname("WOODLOUSE_BOTS_ALONE")
      ->check(CLI::IsMember({"play", "stand"}))
      ->capture_default_str();
  app.add_option("--step-threads", serve.step_threads,
                 "Threads that share a tick of a room with many lice, where the cores are free for them; the "
                 "same bits. Rooms have them in turns")
      ->envname("WOODLOUSE_STEP_THREADS")
      ->check(whole_number(1, core::ThreadTeam::kMostThreads))
      ->capture_default_str();
  app.add_option("--log-format", typed.log_format, "Of the log")
      ->envname("WOODLOUSE_LOG_FORMAT")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  app.add_option("--log-file", serve.log_file,
                 "Log to the end of this file instead of standard error; SIGUSR1 opens it anew")
      ->envname("WOODLOUSE_LOG_FILE");
  app.add_option("--log-level", serve.log_level, "Least severe of what is logged; SIGHUP reads it again")
      ->envname("WOODLOUSE_LOG_LEVEL")
      ->check(CLI::IsMember(log_levels()))
      ->capture_default_str();
  serve.limits.messages_per_s = serve.limits.burst = 0;
  add_limit_options(app, serve.limits);
  app.add_option("--config", typed.config_file,
                 "JSON file with any of these options; SIGHUP reads its limits and log level again")
      ->envname("WOODLOUSE_CONFIG");
}

CLI::App* add_fork(CLI::App& app, Typed& typed) {
  CLI::App* fork = app.add_subcommand("fork", "Serve a live room that goes on from a tick of a recording");
  fork->add_option("file", typed.fork_point.recording, "A recording")->required();
  fork->add_option("--tick", typed.fork_point.tick, "Where to go on")->required()->check(whole_number(0));
  add_maps(*fork, typed.fork_point.maps);
  fork->add_flag("--adopt-by-name", typed.fork_point.adopts_by_name,
                 "Who joins under a recorded name takes that louse over, whoever it is");
  add_serve_options(*fork, typed.fork);
  fork->footer(kForkExamples);
  return fork;
}

/// Options that neither a flag nor a variable gave take the file's value.
core::Expected<bool> apply_config_file(CLI::App& app, const std::string& file) {
  const auto options = read_config_file(file);
  if (!options) return tl::unexpected(options.error());
  for (const auto& [name, values] : *options) {
    CLI::Option* option = name == "config" || name == "help" || name == "version"
                              ? nullptr
                              : app.get_option_no_throw("--" + name);
    if (!option) return core::fail(file + ": " + name, "no such option", "see woodlouse-server --help");
    if (option->count() > 0) continue;
    for (const std::string& value : values) option->add_result(value);
    try {
      option->run_callback();
    } catch (const CLI::Error& error) {
      return core::fail(file, error.what());
    }
  }
  return true;
}

core::Expected<Config> checked(CLI::App& app, TypedServe& typed) {
  if (!typed.config_file.empty())
    if (const auto applied = apply_config_file(app, typed.config_file); !applied)
      return tl::unexpected(applied.error());
  ServeConfig& serve = typed.serve;
  if (!serve.fork) {
    if (serve.maps.empty() && !typed.cluster.is_edge)
      return core::fail("--map", "no map given", "try:  woodlouse-server --map maps/volcano.json");
    if (serve.maps.size() > kMaxRooms)
      return core::fail("--map",
                        std::to_string(serve.maps.size()) + " maps are more rooms than a server opens",
                        "at most " + std::to_string(kMaxRooms) + "; start another server for the others");
    if (const auto fits = check_state_hz(serve.state_hz, serve.tick_hz); !fits)
      return tl::unexpected(fits.error());
  }
  auto listen = parse_listen_address(typed.listen);
  if (!listen) return tl::unexpected(listen.error());
  serve.listen = std::move(*listen);
  std::vector<ProxyNetwork> networks;
  for (const std::string& text : typed.trusted_proxies) {
    auto network = checked_proxy(text);
    if (!network) return tl::unexpected(network.error());
    networks.push_back(std::move(*network));
  }
  serve.trusted_proxies = TrustedProxies(std::move(networks));
  auto web = checked_web(typed.web);
  if (!web) return tl::unexpected(web.error());
  serve.web = std::move(*web);
  auto admin = checked_admin(typed.admin);
  if (!admin) return tl::unexpected(admin.error());
  serve.admin = std::move(*admin);
  auto record = checked_record(typed.record, serve.rotate ? 1 : serve.maps.size());
  if (!record) return tl::unexpected(record.error());
  serve.record = std::move(*record);
  auto cluster = checked_cluster(typed.cluster, serve);
  if (!cluster) return tl::unexpected(cluster.error());
  serve.cluster = std::move(*cluster);
  serve.bots_skill = bots::skill_from_text(typed.bots_skill).value_or(bots::Skill::kFair);
  serve.bots_alone_play = typed.bots_alone == "play";
  serve.mode = state::mode_from_text(typed.mode);
  serve.log_format = typed.log_format == "json" ? LogFormat::kJson : LogFormat::kText;
  return Config{std::move(serve)};
}

}  // namespace

namespace {

/// The rates at and around `state_hz` that divide the tick rate, in words. REQUIRES that it does not.
std::string nearest_divisors(std::uint32_t state_hz, std::uint32_t tick_hz) {
  std::uint32_t below = std::min(state_hz, tick_hz);
  while (tick_hz % below != 0) --below;
  std::uint32_t above = std::min(state_hz, tick_hz);
  while (tick_hz % above != 0) ++above;
  assert(below >= 1 && above <= tick_hz);
  return below == above ? std::to_string(below) : std::to_string(below) + " or " + std::to_string(above);
}

}  // namespace

core::Expected<void> check_state_hz(std::uint32_t state_hz, std::uint32_t tick_hz) {
  if (tick_hz % state_hz == 0) return {};
  return core::fail("--state-hz " + std::to_string(state_hz),
                    "does not divide the tick rate " + std::to_string(tick_hz),
                    "frames fall on ticks: take " + nearest_divisors(state_hz, tick_hz));
}

core::Expected<Config> parse_config(int argc, const char* const* argv) {
  Typed typed;
  CLI::App app("Woodlouse: a game server for wood-lice on a spline hill.", "woodlouse-server");
  app.set_version_flag("--version", std::string(kServerName));
  app.footer(kExamples);
  add_game_options(app, typed.serve);
  add_serve_options(app, typed.serve);
  CLI::App* check = add_check(app, typed.check);
  CLI::App* make_map = add_make_map(app, typed.make_map.request);
  CLI::App* verify = add_verify(app, typed.verify.request);
  CLI::App* inspect = add_inspect(app, typed.inspect.request);
  CLI::App* records = add_records_command(app, typed.records.request);
  CLI::App* fork = add_fork(app, typed);
  CLI::App* admin = add_admin_command(app, typed.errand);
  CLI::App* cluster = add_cluster_command(app, typed.cluster);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return Config{PrintConfig{std::string(kServerName) + "\n"}};
  } catch (const CLI::CallForHelp&) {
    CLI::App* shown = &app;
    for (CLI::App* command : {check, make_map, verify, inspect, records, fork, admin, cluster})
      if (command->parsed())
        shown =
            command == records || command == admin || command == cluster ? named_command(command) : command;
    return Config{PrintConfig{shown->help()}};
  } catch (const CLI::Error& error) {
    std::string hint = "see woodlouse-server ";
    for (const CLI::App* command : app.get_subcommands()) hint += command->get_name() + ' ';
    return core::fail({}, error.what(), hint + "--help");
  }
  if (check->parsed()) return Config{typed.check};
  if (make_map->parsed()) return Config{typed.make_map};
  if (verify->parsed()) return Config{typed.verify};
  if (inspect->parsed()) return Config{typed.inspect};
  if (records->parsed()) return Config{typed.records};
  if (admin->parsed()) {
    auto errand = checked_errand(typed.errand);
    if (!errand) return tl::unexpected(errand.error());
    return Config{AdminConfig{std::move(*errand)}};
  }
  if (cluster->parsed()) {
    auto errand = checked_cluster_errand(typed.cluster);
    if (!errand) return tl::unexpected(errand.error());
    return Config{ClusterConfig{std::move(*errand)}};
  }
  if (!fork->parsed()) return checked(app, typed.serve);
  typed.fork.serve.fork = typed.fork_point;
  return checked(*fork, typed.fork);
}

}  // namespace woodlouse::server
