#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/protocol/text_cleaning.h"
#include "shared/replay/inspect.h"
#include "shared/replay/line_fields.h"
#include "shared/replay/line_reader.h"

namespace woodlouse::replay {
namespace {

constexpr std::int64_t kLongestMargin = 10'000;  // [ms]; more counts as this
/// So many margins, of all players, are told apart by the millisecond, later ones by the second: bounded
/// memory.
constexpr std::size_t kExactMargins = 1'000'000;

/// What a player's inputs were.
struct Punctuality {
  std::uint64_t inputs = 0;
  std::uint64_t late = 0;
  std::uint64_t known = 0;                        ///< with a margin
  std::map<std::int64_t, std::uint64_t> margins;  ///< how many of each [ms]

  /// step: margins count in multiples of it [ms]. Whether a margin is one that had not come before.
  bool add(const std::optional<std::int64_t>& margin, std::int64_t step) {
    ++inputs;
    if (!margin) return false;
    ++known;
    if (*margin < 0) ++late;
    return ++margins[std::clamp(*margin, -kLongestMargin, kLongestMargin) / step * step] == 1;
  }
  /// The margin that this share of the inputs did not reach.
  [[nodiscard]] std::int64_t quantile(double share) const {
    auto below = static_cast<std::uint64_t>(share * static_cast<double>(known));
    for (const auto& [margin, count] : margins) {
      if (below < count) return margin;
      below -= count;
    }
    return margins.empty() ? 0 : margins.rbegin()->first;
  }
};

/// What all lines say.
struct Reading {
  ReplayIndex lines;
  std::map<match::PlayerId, Punctuality> inputs;
  std::uint64_t pauses = 0;
  std::uint64_t paused_seconds = 0;  ///< in all
};

core::Expected<Reading> read_through(const ReplayArchive& archive) {
  const auto stream = archive.source().open();
  if (!stream) return tl::unexpected(stream.error());
  ReplayReader reader(**stream, archive.source().name);
  if (const auto header = reader.read_header(); !header) return tl::unexpected(header.error());
  Reading reading;
  std::size_t margins = 0;
  for (;;) {
    const core::Expected<std::optional<Line>> line = reader.next_line();
    if (!line) return tl::unexpected(line.error());
    if (!*line) return reading;
    if (const auto* keyframe = std::get_if<Keyframe>(&**line))
      reading.lines.add({keyframe->state.tick, reader.line_offset(), reader.line_number()}, *keyframe);
    if (const auto* chat = std::get_if<ChatLine>(&**line)) reading.lines.add(*chat);
    if (const auto* pause = std::get_if<PauseLine>(&**line)) {
      ++reading.pauses;
      reading.paused_seconds += pause->until - std::min(pause->from, pause->until);
    }
    if (auto* end = std::get_if<End>(&**line)) reading.lines.end = std::move(*end);
    const auto* step = std::get_if<StepLine>(&**line);
    if (step == nullptr) continue;
    reading.lines.add(*step);
    for (std::size_t k = 0; k < step->step.inputs.size(); ++k) {
      const match::PlayerId player = step->step.inputs[k].player;
      if (reading.lines.find(player) == nullptr) continue;  // nobody else is told of
      if (reading.inputs[player].add(step->margins_ms[k], margins < kExactMargins ? 1 : 1000)) ++margins;
    }
  }
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[256];
  const int size = std::snprintf(text, sizeof text, format, values...);
  return std::string(
      text, std::clamp<std::size_t>(static_cast<std::size_t>(std::max(size, 0)), 0, sizeof text - 1));
}

/// What came in a file, for a terminal.
std::string shown(std::string_view text) { return protocol::clean_text(text, kMaxTextBytes); }

std::string head(const ReplayArchive& archive, const Reading& reading) {
  const ReplayIndex& lines = reading.lines;
  const Header& header = archive.header();
  std::string out = core::joined(
      {archive.source().name, "\nmap      ", shown(header.map_name), " ", core::to_hex(header.map_hash),
       "\nplayed   by ", shown(header.build), ", behavior ", std::to_string(header.behavior), ", seed ",
       std::to_string(header.seed), ", ", std::to_string(header.tick_hz), " ticks/s\n"});
  if (header.mode != state::Mode::kRoam)
    out += core::joined({"mode     ", state::to_text(header.mode), "\n"});
  if (header.parent) {
    out += core::joined({"goes on  from ", shown(header.parent->file), " at tick ",
                         std::to_string(header.parent->tick), "\n"});
  }
  const std::uint64_t first = lines.keyframes.front().tick;
  const std::uint64_t ticks = lines.last_tick - first;
  out += core::joined({"ticks    ", std::to_string(first), " to ", std::to_string(lines.last_tick),
                       formatted(", %.1f s; ", static_cast<double>(ticks) / header.tick_hz),
                       lines.end ? core::joined({"ended: ", shown(lines.end->reason)})
                                 : std::string("cut off, without an end"),
                       "\n"});
  std::uint64_t counts[4] = {};
  for (const Mark& mark : lines.marks) ++counts[static_cast<std::size_t>(mark.kind)];
  out += core::joined({"events   ", std::to_string(counts[0]), " joins, ", std::to_string(counts[1]),
                       " leaves, ", std::to_string(counts[2]), " respawns, ", std::to_string(counts[3]),
                       " chats\n"});
  out += core::joined({"inputs   ", std::to_string(lines.inputs), "\n"});
  if (reading.pauses != 0) {
    out += core::joined({"pauses   ", std::to_string(reading.pauses), ", in which nobody was there, ",
                         std::to_string(reading.paused_seconds), " s in all\n"});
  }
  const std::string unlike = unlike_index(archive.index(), lines);
  if (!unlike.empty())
    out += core::joined({"index    is not that of the lines, which are told here: ", unlike, "\n"});
  return out + "\n";
}

std::string row(const PlayerSpan& player, const Punctuality& inputs) {
  const std::string left = player.left ? std::to_string(*player.left) : "-";
  std::string out = formatted("%6lu %-6s %8lu %8s %9lu", static_cast<unsigned long>(player.player),
                              std::string(protocol::to_text(player.label.role)).c_str(),
                              static_cast<unsigned long>(player.joined), left.c_str(),
                              static_cast<unsigned long>(inputs.inputs));
  if (inputs.known == 0) {
    out += "        -       -       -       -";
  } else {
    out += formatted(" %8lu %7ld %7ld %7ld", static_cast<unsigned long>(inputs.late),
                     static_cast<long>(inputs.quantile(0.5)), static_cast<long>(inputs.quantile(0.01)),
                     static_cast<long>(inputs.margins.begin()->first));
  }
  return core::joined({out, "  ", shown(player.label.name), "\n"});
}

}  // namespace

core::Expected<std::string> inspect_summary(const ReplayArchive& archive) {
  const core::Expected<Reading> reading = read_through(archive);
  if (!reading) return tl::unexpected(reading.error());
  std::string out = head(archive, *reading);
  out += "margin: how long before its step an input came; 99 of 100 came at least `99%` ms before\n";
  out += "player role     joined     left    inputs     late  median     99%   least  name\n";
  for (const PlayerSpan& player : reading->lines.players) {
    const auto found = reading->inputs.find(player.player);
    out += row(player, found != reading->inputs.end() ? found->second : Punctuality{});
  }
  return out;
}

}  // namespace woodlouse::replay
