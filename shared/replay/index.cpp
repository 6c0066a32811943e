#include "shared/replay/index.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "shared/core/joined.h"
#include "shared/replay/line_reader.h"

namespace woodlouse::replay {

std::string_view to_text(MarkKind kind) {
  switch (kind) {
    case MarkKind::kJoin:
      return "join";
    case MarkKind::kLeave:
      return "leave";
    case MarkKind::kRespawn:
      return "respawn";
    case MarkKind::kChat:
      return "chat";
  }
  assert(false);
  return {};
}

std::size_t ReplayIndex::keyframe_before(std::uint64_t tick) const {
  assert(!keyframes.empty() && tick >= keyframes.front().tick);
  const auto after =
      std::upper_bound(keyframes.begin(), keyframes.end(), tick,
                       [](std::uint64_t t, const KeyframePlace& place) { return t < place.tick; });
  return static_cast<std::size_t>(after - keyframes.begin()) - 1;
}

void ReplayIndex::add(const KeyframePlace& place, const Keyframe& keyframe) {
  keyframes.push_back(place);
  last_tick = std::max(last_tick, place.tick);
  if (keyframes.size() > 1) return;
  // A fork's: nobody saw them join. By the rules of play one of them may have no louse at present.
  match::PlayerLabels labels = keyframe.state.labels;
  for (const state::Louse& louse : keyframe.state.lice) labels.try_emplace(louse.id);
  for (const auto& [player, label] : labels) add_player({player, label, place.tick, {}});
}

void ReplayIndex::add(const StepLine& line) {
  const match::StepRecord& step = line.step;
  last_tick = step.tick + line.steps;
  inputs += step.inputs.size();
  for (const match::RosterChange& change : step.roster) {
    switch (change.action) {
      case match::RosterAction::kJoin:
        add_player({change.player, change.label, step.tick + 1, {}});
        add_mark({step.tick, MarkKind::kJoin, change.player});
        break;
      case match::RosterAction::kLeave:
        if (const PlayerSpan* player = find(change.player))
          players[static_cast<std::size_t>(player - players.data())].left = step.tick + 1;
        add_mark({step.tick, MarkKind::kLeave, change.player});
        break;
      case match::RosterAction::kRespawn:
      case match::RosterAction::kRespawnAtGate:
        add_mark({step.tick, MarkKind::kRespawn, change.player});
        break;
    }
  }
}

void ReplayIndex::add(const ChatLine& line) { add_mark({line.tick, MarkKind::kChat, line.player}); }

void ReplayIndex::add_player(PlayerSpan player) {
  if (players.size() < kMaxPlayers) players.push_back(std::move(player));
}

void ReplayIndex::add_mark(const Mark& mark) {
  if (marks.size() < kMaxMarks) marks.push_back(mark);
}

const PlayerSpan* ReplayIndex::find(match::PlayerId player) const {
  const auto at = std::lower_bound(players.begin(), players.end(), player,
                                   [](const PlayerSpan& p, match::PlayerId id) { return p.player < id; });
  return at != players.end() && at->player == player ? &*at : nullptr;
}

namespace {

/// "row 3 of keyframes", of the first that is another.
template <typename Row>
std::string unlike_rows(std::string_view name, const std::vector<Row>& recorded,
                        const std::vector<Row>& lines) {
  if (recorded == lines) return {};
  const auto [a, b] = std::mismatch(recorded.begin(), recorded.end(), lines.begin(), lines.end());
  return core::joined({"row ", std::to_string(a - recorded.begin() + 1), " of its ", name});
}

}  // namespace

std::string unlike_index(const ReplayIndex& recorded, const ReplayIndex& lines) {
  std::string unlike = unlike_rows("keyframes", recorded.keyframes, lines.keyframes);
  if (unlike.empty()) unlike = unlike_rows("players", recorded.players, lines.players);
  if (unlike.empty()) unlike = unlike_rows("marks", recorded.marks, lines.marks);
  if (unlike.empty() && recorded.inputs != lines.inputs) {
    unlike = core::joined(
        {"its inputs, ", std::to_string(recorded.inputs), ": there are ", std::to_string(lines.inputs)});
  }
  return unlike;
}

core::Expected<ReplayIndex> scan_index(InputStream& in, const std::string& source) {
  in.clear();
  in.seekg(0);
  ReplayReader reader(in, source);
  if (const auto header = reader.read_header(); !header) return tl::unexpected(header.error());
  ReplayIndex index;
  for (;;) {
    const core::Expected<std::optional<Line>> line = reader.next_line();
    if (!line) return tl::unexpected(line.error());
    if (!*line) break;
    if (const auto* keyframe = std::get_if<Keyframe>(&**line)) {
      index.add({keyframe->state.tick, reader.line_offset(), reader.line_number()}, *keyframe);
    }
    if (const auto* step = std::get_if<StepLine>(&**line)) index.add(*step);
    if (const auto* chat = std::get_if<ChatLine>(&**line)) index.add(*chat);
    if (auto* end = std::get_if<End>(&**line)) index.end = *end;
  }
  if (index.keyframes.empty()) return core::fail(source, "was cut off before its first keyframe");
  return index;
}

}  // namespace woodlouse::replay
