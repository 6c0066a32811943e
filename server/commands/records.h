// `woodlouse-server records`: boards in files, shown, re-run, shortened, and runs that are handed in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>

namespace woodlouse::server {

struct RecordsRequest {
  enum class Action : std::uint8_t { kList, kVerify, kPrune, kAdd };
  Action action = Action::kList;
  std::filesystem::path folder;
  std::filesystem::path maps{};   ///< verify: where maps are that a board only names
  std::size_t keep = 0;           ///< prune: rows of each board
  std::filesystem::path ghost{};  ///< add: a ghost's line, as get_ghost gives it
  std::string map{};              ///< add: what it was driven on
};

/// What it says goes to `out`; 0 all well, 1 a run that differs from its re-run, or what can't be read,
/// written or taken.
int records_command(const RecordsRequest& request, std::ostream& out);

}  // namespace woodlouse::server
