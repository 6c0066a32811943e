// What a room's game begins from: an empty match, or a tick of a recording (fork.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/match/match.h"
#include "shared/protocol/messages.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

/// A louse whose player is only in the recording. Whoever joins under its name takes it over.
struct Orphan {
  match::PlayerId louse = 0;
  std::string name;  ///< cleaned, not empty
  protocol::Role role = protocol::Role::kPlayer;
  std::uint32_t first_seq = 0;  ///< above every seq that was filed for it
};

struct Opening {
  std::shared_ptr<const map::Map> map;
  std::unique_ptr<match::Match> match;  ///< on that map; nothing is queued in it
  std::string map_file;                 ///< for the recording
  std::vector<Orphan> orphans;          ///< by louse; they have one each
  std::optional<replay::Parent> parent;
};

}  // namespace woodlouse::server
