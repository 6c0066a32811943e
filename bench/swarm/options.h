// What the load tool was asked to do; parsed and checked once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "shared/protocol/messages.h"

namespace woodlouse::swarm {

struct Options {
  std::string host = "127.0.0.1";
  std::string port = "7777";
  std::string room;                ///< empty: the server's first
  std::size_t bots = 200;          ///< 1..20000
  double seconds = 20.0;           ///< measured, after all have joined; 0.1..86400
  double inputs_per_second = 5.0;  ///< per bot, 0..1000
  protocol::Format format = protocol::Format::kQuantized;
  std::uint64_t seed = 1;
};

/// The options, or the exit code: of a bad command line (told on standard error), of --help 0.
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace woodlouse::swarm
