#include "client/watch/recorded_chat.h"

#include <algorithm>

#include "shared/core/joined.h"

namespace woodlouse::client {

std::string name_of(const match::PlayerLabel* label, std::uint32_t player) {
  return label != nullptr && !label->name.empty() ? label->name : core::joined({"#", std::to_string(player)});
}

void RecordedChat::add(std::span<const replay::ChatLine> said) {
  std::map<Place, std::vector<ChatLine>> fresh;
  for (const replay::ChatLine& line : said) fresh[{line.tick, line.player}].push_back({line.name, line.text});
  for (auto& [place, lines] : fresh)
    said_[place] = std::move(lines);  // a tick seen again says the same again
}

std::vector<ChatLine> RecordedChat::lines(std::span<const replay::Mark> marks,
                                          const std::map<std::uint32_t, match::PlayerLabel>& labels,
                                          std::uint64_t tick) const {
  const auto end = std::partition_point(marks.begin(), marks.end(),
                                        [tick](const replay::Mark& mark) { return mark.tick < tick; });
  const auto begin = end - std::min<std::ptrdiff_t>(end - marks.begin(), static_cast<std::ptrdiff_t>(kLines));
  std::vector<ChatLine> lines;
  std::map<Place, std::size_t> spoken;
  for (auto mark = begin; mark != end; ++mark) {
    const auto label = labels.find(mark->player);
    const std::size_t nth =
        mark->kind == replay::MarkKind::kChat ? spoken[Place{mark->tick, mark->player}]++ : 0;
    lines.push_back(line(*mark, label == labels.end() ? nullptr : &label->second, nth));
  }
  return lines;
}

ChatLine RecordedChat::line(const replay::Mark& mark, const match::PlayerLabel* label,
                            std::size_t nth) const {
  const std::string name = name_of(label, mark.player);
  switch (mark.kind) {
    case replay::MarkKind::kJoin:
      return {"", (label != nullptr && label->role == protocol::Role::kBot ? "bot " : "") + name + " joined"};
    case replay::MarkKind::kLeave:
      return {"", name + " left"};
    case replay::MarkKind::kRespawn:
      return {"", name + " starts again"};
    case replay::MarkKind::kChat:
      break;
  }
  const auto said = said_.find({mark.tick, mark.player});
  if (said == said_.end() || nth >= said->second.size()) return {mark.player == 0 ? "..." : name, "..."};
  const ChatLine& known = said->second[nth];  // a spectator has no label, only the name with his words
  return {known.from.empty() ? name : known.from, known.text};
}

}  // namespace woodlouse::client
