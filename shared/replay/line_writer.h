// The text of a recording's lines, newline included; what line_reader.cpp reads back.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "shared/replay/format.h"

namespace woodlouse::replay {

/// [ms] by player and seq.
using Margins = std::map<std::pair<match::PlayerId, std::uint32_t>, std::int64_t>;

/// [ms], down: what came late stays negative.
constexpr std::int64_t whole_milliseconds(std::int64_t us) {
  return us >= 0 ? us / 1000 : -((999 - us) / 1000);
}

void append_header(std::string& out, const Header& header);
/// REQUIRES that state.roster is empty.
void append_keyframe(std::string& out, const match::MatchState& state);
void append_step(std::string& out, const match::StepRecord& step, const Margins& margins);
/// Steps from `first` on that applied nothing and left the hash as it was. REQUIRES steps >= 1.
void append_quiet_steps(std::string& out, std::uint64_t first, std::uint64_t steps, std::uint64_t hash);
void append_chat(std::string& out, const ChatLine& line);
void append_pause(std::string& out, const PauseLine& line);
void append_end(std::string& out, const End& end);

}  // namespace woodlouse::replay
