// `woodlouse-server verify`: recordings in files, judged.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

namespace woodlouse::server {

struct VerifyRequest {
  std::vector<std::filesystem::path> files;
  std::filesystem::path maps{};  ///< where maps are that are only named; empty: beside the recordings alone
  unsigned jobs = 1;
  bool from_start = false;  ///< one whose start is taken on trust is not good enough
  bool complete = false;    ///< nor is one that is cut off
};

/// Prints the verdicts to `out`, of several files each under its name; 0 all the same, 1 one different,
/// unreadable, or less than was asked for.
int verify_command(const VerifyRequest& request, std::ostream& out);

}  // namespace woodlouse::server
