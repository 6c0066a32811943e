#include "shared/rules/event.h"

#include <cassert>
#include <cstddef>
#include <utility>

namespace woodlouse::rules {
namespace {

/// In the order of EventKind; and how many values each has.
constexpr std::array<std::pair<std::string_view, std::size_t>, 12> kKinds = {{{"gate", 4},
                                                                              {"lap", 3},
                                                                              {"run", 3},
                                                                              {"crumb", 4},
                                                                              {"harvest", 0},
                                                                              {"bump", 2},
                                                                              {"holds", 0},
                                                                              {"contested", 0},
                                                                              {"moving", 2},
                                                                              {"fell", 1},
                                                                              {"returned", 0},
                                                                              {"round", 3}}};
static_assert(kKinds.size() == static_cast<std::size_t>(EventKind::kRound) + 1);

}  // namespace

std::string_view to_text(EventKind kind) { return kKinds[static_cast<std::size_t>(kind)].first; }

std::string to_text(const Event& event) {
  const auto& [name, values] = kKinds[static_cast<std::size_t>(event.kind)];
  assert(values <= event.values.size());
  std::string text = std::to_string(event.moment);
  text += ' ';
  text += name;
  text += ' ';
  text += std::to_string(event.louse);
  for (std::size_t k = 0; k < values; ++k) {
    text += ' ';
    text += event.values[k] == kNone ? std::string("-") : std::to_string(event.values[k]);
  }
  return text;
}

}  // namespace woodlouse::rules
