// `woodlouse-server inspect`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

namespace woodlouse::server {

struct InspectRequest {
  std::filesystem::path file;
  std::filesystem::path maps{};  ///< where a map is that is only named; empty: beside the recording alone
  std::optional<std::uint64_t> tick;
  std::optional<double> seconds;  ///< since tick 0; >= 0
  bool rulings = false;           ///< what the rules of play said
  bool error = false;             ///< how far its steps err
  bool summary = false;           ///< also when neither tick nor seconds are asked for
};

/// 0; 1 when it can't be read, or the state is not the recorded one: told on `errors`.
int inspect_command(const InspectRequest& request, std::ostream& out, std::ostream& errors);

}  // namespace woodlouse::server
