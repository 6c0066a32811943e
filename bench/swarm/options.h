// What the load tool was asked to do; parsed and checked once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "shared/protocol/messages.h"

namespace woodlouse::swarm {

inline constexpr double kHealthyInputsPerSecond = 5.0;

struct Options {
  std::string host = "127.0.0.1";
  std::string port = "7777";
  std::vector<std::string> rooms;  ///< joined in turns; empty: the server's first
  std::size_t bots = 200;          ///< 0..20000; 0 when anything else of a crowd is asked for
  double seconds = 20.0;           ///< measured, after all have joined; 0.1..86400
  double inputs_per_second = 5.0;  ///< per bot, 0..1000
  protocol::Format format = protocol::Format::kQuantized;
  std::uint32_t view_rows = 0;  ///< that each asks for at most; 0: it is shown everybody
  std::uint64_t seed = 1;
  double joins_per_second = 500.0;

  // A crowd.
  bool is_crowd = false;  ///< anything of the following was asked for
  std::size_t spectators = 0;
  std::size_t addresses = 0;  ///< 0: whatever the system takes
  std::size_t chatters = 0;
  double chats_per_second = 1.0;  ///< of each
  bool chatters_apart = true;     ///< from one address of their own
  std::size_t askers = 0;
  std::string ask = "get_map";  ///< or "resync", "list"
  double stalled_percent = 0.0;
  std::size_t inputs_per_tick = 0;
  double churn_per_second = 0.0;
  bool resume = false;
  std::size_t healthy = 0;
  protocol::Role healthy_role = protocol::Role::kSpectator;
  double before_seconds = 3.0;  ///< the healthy are measured before the load comes
  bool raw = false;             ///< bytes are counted, no protocol
};

/// The options, or the exit code: of a bad command line (told on standard error), of --help 0.
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace woodlouse::swarm
