#include "bench/swarm/options.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "bench/option_failure.h"
#include "bench/swarm/profile.h"
#include "server/option_checks.h"

namespace woodlouse::swarm {
namespace {

constexpr std::size_t kMostClients = 20000;
constexpr std::size_t kHealthyBesideHostile = 5;

const CLI::Range kClients(std::size_t{0}, kMostClients);

/// What the options of a crowd are written to, and whether any of them was given.
struct Crowd {
  Options& options;
  std::string healthy_role = "spectator";
  std::vector<CLI::Option*> loads{}, hostile{}, others{};
  CLI::Option* healthy = nullptr;

  void add_to(CLI::App& app) {
    const auto add = [&app](auto& list, const char* name, auto& value, const char* help) {
      list.push_back(app.add_option(name, value, help)->capture_default_str());
      return list.back();
    };
    add(loads, "--spectators", options.spectators, "silent watchers")->check(kClients);
    add(hostile, "--chatters", options.chatters, "spectators that chat, from one address of their own")
        ->check(kClients);
    add(others, "--chats-per-second", options.chats_per_second, "of each chatter")
        ->check(CLI::Range(0.01, 1000.0));
    others.push_back(app.add_flag("!--chatters-among-others", options.chatters_apart,
                                  "chatters take the addresses of all"));
    add(hostile, "--askers", options.askers, "spectators that ask as fast as the limits allow")
        ->check(kClients);
    add(others, "--ask", options.ask, "what they ask for")
        ->check(CLI::IsMember({"get_map", "resync", "list"}));
    add(hostile, "--stalled", options.stalled_percent, "percent of the clients that read nothing once joined")
        ->check(CLI::Range(0.0, 100.0));
    add(hostile, "--inputs-per-tick", options.inputs_per_tick,
        "that each bot files for one tick, over and over")
        ->check(CLI::Range(std::size_t{0}, std::size_t{1000}));
    add(hostile, "--churn", options.churn_per_second, "clients a second that join and vanish")
        ->check(CLI::Range(0.0, 1000.0));
    loads.push_back(app.add_flag("--resume", options.resume,
                                 "halfway the bots' connections are cut, and they come back 1 s later"));
    add(others, "--addresses", options.addresses, "bind to 127.0.0.1, 127.0.0.2 ... in turns; 0: do not")
        ->check(CLI::Range(std::size_t{0}, std::size_t{10000}));
    healthy = add(others, "--healthy", options.healthy,
                  "watchers that join first and are measured apart (5 beside hostile clients)");
    healthy->check(CLI::Range(std::size_t{0}, std::size_t{1000}));
    add(others, "--healthy-role", healthy_role, "players steer 5 times a second")
        ->check(CLI::IsMember({"spectator", "player"}));
    add(others, "--before", options.before_seconds, "seconds they are measured before the load comes")
        ->check(CLI::Range(0.0, 3600.0));
    others.push_back(app.add_flag("--raw", options.raw, "connect, read and count bytes; no protocol"));
  }

  void settle(const CLI::Option& bots) {
    const auto any = [](const std::vector<CLI::Option*>& list) {
      return std::any_of(list.begin(), list.end(), [](const auto* option) { return option->count() != 0; });
    };
    options.is_crowd = any(loads) || any(hostile) || any(others);
    const bool has_others =
        options.spectators + options.chatters + options.askers != 0 || options.churn_per_second > 0.0;
    if (has_others && bots.count() == 0) options.bots = 0;
    if (healthy->count() == 0) options.healthy = any(hostile) ? kHealthyBesideHostile : 0;
    if (healthy_role == "player") options.healthy_role = protocol::Role::kPlayer;
  }
};

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::string address = options.host + ":" + options.port;
  CLI::App app("Connects many bots that steer at random, and measures what each of them gets.");
  app.add_option("address", address, "HOST:PORT of the server")->capture_default_str();
  auto* bots = app.add_option("--bots", options.bots, "how many; none beside another load unless asked for")
                   ->check(kClients)
                   ->capture_default_str();
  app.add_option("--seconds", options.seconds, "how long to measure, once all have joined")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  app.add_option("--inputs-per-second", options.inputs_per_second, "that each bot sends")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  std::string format = "quantized";
  app.add_option("--format", format, "of the rows")
      ->check(CLI::IsMember({"quantized", "exact"}))
      ->capture_default_str();
  app.add_option("--view-rows", options.view_rows, "each is shown so many, the nearest; 0: all")
      ->check(CLI::Range(0u, protocol::kEveryRow))
      ->capture_default_str();
  app.add_option("--room", options.rooms, "to join, of several in turns; the server's first when left out");
  app.add_option("--seed", options.seed, "of the steering")
      ->check(server::whole_number(0))
      ->capture_default_str();
  app.add_option("--joins-per-second", options.joins_per_second, "how fast they come")
      ->check(CLI::Range(0.1, 1e5))
      ->capture_default_str();
  Crowd crowd{options};
  crowd.add_to(app);
  app.failure_message(bench::option_failure);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  crowd.settle(*bots);
  options.format = format == "exact" ? protocol::Format::kExact : protocol::Format::kQuantized;
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == address.size()) {
    std::cerr << "woodlouse-swarm: the address \"" << address << "\" is not HOST:PORT\n"
              << "try: woodlouse-swarm --bots 20 --seconds 5 127.0.0.1:7777\n";
    return 2;
  }
  if (load_profiles(options).empty() && options.healthy == 0 && options.churn_per_second == 0.0) {
    std::cerr << "woodlouse-swarm: nobody is to connect\n"
              << "try: woodlouse-swarm --bots 20 --seconds 5 127.0.0.1:7777\n";
    return 2;
  }
  options.host = address.substr(0, colon);
  options.port = address.substr(colon + 1);
  if (options.host.starts_with('[') && options.host.ends_with(']'))
    options.host = options.host.substr(1, options.host.size() - 2);
  return options;
}

}  // namespace woodlouse::swarm
