// What the server's process is told from outside, and what its system allows it.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

#include <cstdint>
#include <vector>

namespace woodlouse::server {

/// What a server listens to: TERM, INT, QUIT, USR2, ALRM end it in order, everybody is told and all is
/// written; none of the signals that end a program is a crash. HUP has it read its limits and log level
/// again, USR1 begin new files. But those that whoever started it has ignored: nohup's HUP stays so.
std::vector<int> taken_signals();

/// While it lives, those signals end nothing by themselves, whoever listens to them. Asio gives a signal back
/// to the system, which ends the program by it, when the last one who listens has gone; and the log may still
/// be written then.
class KeptSignals {
 public:
  explicit KeptSignals(const std::vector<int>& signals) : set_(context_) {
    for (const int signal : signals) set_.add(signal);
  }

 private:
  boost::asio::io_context context_{1};  ///< never run
  boost::asio::signal_set set_;
};

/// Whether a terminal controls this process: a HUP from then on, once there is none, is the terminal's end.
bool has_terminal();

/// Raises the limit of open files as far as the system lets it; how many there may be.
std::uint64_t raise_descriptor_limit();

}  // namespace woodlouse::server
