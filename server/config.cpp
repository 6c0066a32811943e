#include "server/config.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include "server/config_file.h"
#include "server/version.h"

namespace woodlouse::server {
namespace {

constexpr std::uint32_t kMaxTickHz = 1000;
constexpr std::uint32_t kMaxBots = 1000;

/// The options as typed, before they are checked against each other.
struct Typed {
  ServeConfig serve;
  CheckConfig check;
  VerifyConfig verify;
  std::string listen = "127.0.0.1:7777";
  std::string config_file;
};

void add_serve_options(CLI::App& app, Typed& typed) {
  static const std::map<std::string, LogFormat> kLogFormats = {{"text", LogFormat::kText},
                                                               {"json", LogFormat::kJson}};
  ServeConfig& serve = typed.serve;
  app.add_option("--map", serve.maps, "Map file; several make several rooms")->envname("WOODLOUSE_MAP");
  app.add_option("--listen", typed.listen,
                 "HOST:PORT; port 0 picks a free one, printed as `listening HOST:PORT`")
      ->envname("WOODLOUSE_LISTEN")
      ->capture_default_str();
  app.add_option("--tick-hz", serve.tick_hz, "Steps a second")
      ->envname("WOODLOUSE_TICK_HZ")
      ->check(CLI::Range(1u, kMaxTickHz))
      ->capture_default_str();
  app.add_option("--state-hz", serve.state_hz, "Frames a second; divides --tick-hz")
      ->envname("WOODLOUSE_STATE_HZ")
      ->check(CLI::Range(1u, kMaxTickHz))
      ->capture_default_str();
  app.add_option("--record", serve.record, "Write a recording; with several rooms one file each, by room")
      ->envname("WOODLOUSE_RECORD");
  app.add_option("--ticks", serve.ticks, "Stop after so many ticks")
      ->envname("WOODLOUSE_TICKS")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", serve.seed, "Seed of spawns and bots; another one each time when left out")
      ->envname("WOODLOUSE_SEED");
  app.add_option("--bots", serve.bots, "The house's own bots, in every room")
      ->envname("WOODLOUSE_BOTS")
      ->check(CLI::Range(0u, kMaxBots))
      ->capture_default_str();
  app.add_option("--log-format", serve.log_format, "text or json, on standard error")
      ->envname("WOODLOUSE_LOG_FORMAT")
      ->transform(CLI::CheckedTransformer(kLogFormats))
      ->default_str("text");
  app.add_option("--config", typed.config_file, "JSON file with any of these options")
      ->envname("WOODLOUSE_CONFIG");
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

core::Expected<Config> checked(Typed typed) {
  ServeConfig& serve = typed.serve;
  if (serve.maps.empty())
    return core::fail("--map", "no map given", "try:  woodlouse-server --map maps/volcano.json");
  if (serve.tick_hz % serve.state_hz != 0)
    return core::fail("--state-hz " + std::to_string(serve.state_hz),
                      "does not divide --tick-hz " + std::to_string(serve.tick_hz),
                      "frames fall on ticks: for 60 take 60, 30, 20, 15, 12 or 10");
  auto listen = parse_listen_address(typed.listen);
  if (!listen) return tl::unexpected(listen.error());
  serve.listen = std::move(*listen);
  return Config{std::move(serve)};
}

}  // namespace

core::Expected<Config> parse_config(int argc, const char* const* argv) {
  Typed typed;
  CLI::App app("Woodlouse: a game server for wood-lice on a spline hill.", "woodlouse-server");
  app.set_version_flag("--version", std::string(kServerName));
  add_serve_options(app, typed);
  CLI::App* check = app.add_subcommand("check", "Say what is wrong with map files");
  check->add_option("map", typed.check.maps, "Map files")->required();
  CLI::App* verify = app.add_subcommand("verify", "Re-run a recording and compare");
  verify->add_option("file", typed.verify.file, "A recording")->required();
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return Config{PrintConfig{std::string(kServerName) + "\n"}};
  } catch (const CLI::CallForHelp&) {
    CLI::App* shown = check->parsed() ? check : verify->parsed() ? verify : &app;
    return Config{PrintConfig{shown->help()}};
  } catch (const CLI::Error& error) {
    return core::fail({}, error.what(), "see woodlouse-server --help");
  }
  if (check->parsed()) return Config{typed.check};
  if (verify->parsed()) return Config{typed.verify};
  if (!typed.config_file.empty())
    if (const auto applied = apply_config_file(app, typed.config_file); !applied)
      return tl::unexpected(applied.error());
  return checked(std::move(typed));
}

}  // namespace woodlouse::server
