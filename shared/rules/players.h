// Those who play by a mode, by ascending id: what each mode keeps of a louse.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "shared/state/louse.h"

namespace woodlouse::rules {

/// Player has `id`.
template <typename Player>
class Players {
 public:
  /// REQUIRES that nobody has the id.
  Player& add(Player player) {
    const auto place = at(player.id);
    assert(place == all_.end() || place->id != player.id);
    return *all_.insert(place, std::move(player));
  }
  /// REQUIRES that somebody has it.
  void remove(state::LouseId id) {
    const auto place = at(id);
    assert(place != all_.end() && place->id == id);
    all_.erase(place);
  }
  [[nodiscard]] Player* find(state::LouseId id) {
    const auto place = at(id);
    return place != all_.end() && place->id == id ? &*place : nullptr;
  }
  [[nodiscard]] const Player* find(state::LouseId id) const { return const_cast<Players*>(this)->find(id); }

  auto begin() { return all_.begin(); }
  auto end() { return all_.end(); }
  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] bool empty() const { return all_.empty(); }
  void clear() { all_.clear(); }
  /// Whether they are these, in this order.
  [[nodiscard]] bool are(std::span<const state::LouseId> ids) const {
    return std::equal(all_.begin(), all_.end(), ids.begin(), ids.end(),
                      [](const Player& player, state::LouseId id) { return player.id == id; });
  }

 private:
  typename std::vector<Player>::iterator at(state::LouseId id) {
    return std::lower_bound(all_.begin(), all_.end(), id,
                            [](const Player& player, state::LouseId wanted) { return player.id < wanted; });
  }
  std::vector<Player> all_;
};

}  // namespace woodlouse::rules
