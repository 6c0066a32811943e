// How a run of the client ended.
#pragma once

#include <string>

namespace woodlouse::client {

inline constexpr int kExitFine = 0;
inline constexpr int kExitDiffers = 1;  ///< a verified state was not what was stated
inline constexpr int kExitUsage = 2;
inline constexpr int kExitUnreachable = 69;   ///< EX_UNAVAILABLE
inline constexpr int kExitIo = 74;            ///< EX_IOERR
inline constexpr int kExitInterrupted = 130;  ///< Ctrl-C

struct Outcome {
  int exit_code = kExitFine;
  std::string message;  ///< for standard error, once the terminal is the user's again; may be empty
};

}  // namespace woodlouse::client
