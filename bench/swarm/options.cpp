#include "bench/swarm/options.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "bench/option_failure.h"
#include "server/option_checks.h"

namespace woodlouse::swarm {

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  std::string address = options.host + ":" + options.port;
  CLI::App app("Connects many bots that steer at random, and measures what each of them gets.");
  app.add_option("address", address, "HOST:PORT of the server")->capture_default_str();
  app.add_option("--bots", options.bots, "how many")->check(CLI::Range(1, 20000))->capture_default_str();
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
  app.add_option("--room", options.room, "to join; the server's first when left out");
  app.add_option("--seed", options.seed, "of the steering")
      ->check(server::whole_number(0))
      ->capture_default_str();
  app.failure_message(bench::option_failure);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  options.format = format == "exact" ? protocol::Format::kExact : protocol::Format::kQuantized;
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == address.size()) {
    std::cerr << "woodlouse-swarm: the address \"" << address << "\" is not HOST:PORT\n"
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
