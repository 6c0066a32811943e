// What was said in a recording, as far as it is known by now: the time line says who spoke and when, the
// words come as the recording is re-run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "client/drawing/scene.h"
#include "shared/replay/archive.h"

namespace woodlouse::client {

/// How a player of a recording is called: the name of the join, or the number.
std::string name_of(const match::PlayerLabel* label, std::uint32_t player);

class RecordedChat {
 public:
  static constexpr std::size_t kLines = 50;  ///< shown at most

  /// What was said before one step.
  void add(std::span<const replay::ChatLine> said);

  /// The newest lines up to a tick, oldest first: chat, and who came, left or began again.
  [[nodiscard]] std::vector<ChatLine> lines(std::span<const replay::Mark> marks,
                                            const std::map<std::uint32_t, match::PlayerLabel>& labels,
                                            std::uint64_t tick) const;

 private:
  using Place = std::pair<std::uint64_t, std::uint32_t>;  ///< tick and player

  [[nodiscard]] ChatLine line(const replay::Mark& mark, const match::PlayerLabel* label,
                              std::size_t nth) const;

  std::map<Place, std::vector<ChatLine>> said_;
};

}  // namespace woodlouse::client
