// By which letter and colour a louse is known, on the map and in the lists alike.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "client/drawing/palette.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// What tells bodies of one colour apart.
enum class Coat : std::uint8_t { kPaleHead, kDarkHead, kPaleHeadAndBelt, kDarkHeadAndBelt };
inline constexpr std::size_t kCoats = 4;

struct Badge {
  char letter = '?';  ///< '@' is you, a..z and A..Z the others, '+' whoever comes behind these
  Rgb color;
  Coat coat = Coat::kPaleHead;
};

/// What a body shows at `along` its length, from -1 at its end to 1 at the tip of its head.
inline Rgb body_color(const Badge& badge, double along) {
  constexpr double kNeck = 0.42;
  constexpr double kBeltEnd = -0.45, kBeltBegin = -0.05;
  const bool has_dark_head = badge.coat == Coat::kDarkHead || badge.coat == Coat::kDarkHeadAndBelt;
  const bool has_belt = badge.coat == Coat::kPaleHeadAndBelt || badge.coat == Coat::kDarkHeadAndBelt;
  if (along > kNeck) return has_dark_head ? kMarkShade : Rgb{255, 255, 250};
  return has_belt && along > kBeltEnd && along < kBeltBegin ? kMarkShade : badge.color;
}

/// Letters, and colours with coats, go by id, so that a louse keeps its own while others come and go; none is
/// given twice: behind 52 lice there are no letters any more, behind 28 colours and coats repeat.
class Badges {
 public:
  explicit Badges(const Scene& scene) : look_(scene.look) {
    for (const LouseMark& louse : scene.lice) add(louse.id, louse.is_you);
    for (const ScoreRow& row : scene.scores) add(row.id, row.is_you);
  }

  [[nodiscard]] Badge of(std::uint32_t id) const {
    const auto found = badges_.find(id);
    return found == badges_.end() ? Badge{} : found->second;
  }

 private:
  void add(std::uint32_t id, bool is_you) {
    if (badges_.contains(id)) return;
    if (is_you) {
      badges_[id] = {'@', louse_color(id, Owner::kYou, look_)};
      return;
    }
    const std::uint32_t slot = free_slot(id);
    badges_[id] = {free_letter(id), louse_color(slot, Owner::kOther, look_),
                   static_cast<Coat>(slot / kBadgeColors)};
  }

  std::uint32_t free_slot(std::uint32_t id) {
    constexpr auto kSlots = static_cast<std::uint32_t>(kBadgeColors * kCoats);
    std::uint32_t slot = id % kSlots;
    if (used_slots_ == (1u << kSlots) - 1) return slot;
    while ((used_slots_ >> slot & 1u) != 0) slot = (slot + 1) % kSlots;
    used_slots_ |= 1u << slot;
    return slot;
  }

  char free_letter(std::uint32_t id) {
    for (const char first : {'a', 'A'}) {
      std::uint32_t& used = first == 'a' ? used_small_ : used_capital_;
      if (used == kAllUsed) continue;
      std::uint32_t letter = (id + 25) % 26;  // ids begin at 1
      while ((used >> letter & 1u) != 0) letter = (letter + 1) % 26;
      used |= 1u << letter;
      return static_cast<char>(first + static_cast<char>(letter));
    }
    return '+';
  }

  static constexpr std::uint32_t kAllUsed = (1u << 26) - 1;
  Look look_;
  std::map<std::uint32_t, Badge> badges_;
  std::uint32_t used_small_ = 0, used_capital_ = 0;  ///< a bit a letter
  std::uint32_t used_slots_ = 0;                     ///< a bit a colour and coat
};

/// The lice as they are to be painted one over the other: yours last. Those that are nowhere near the map are
/// left out.
inline std::vector<const LouseMark*> in_drawing_order(const Scene& scene) {
  std::vector<const LouseMark*> order;
  if (scene.terrain == nullptr) return order;
  const terrain::Rectangle& d = scene.terrain->domain();
  const double beyond = (d.x_max - d.x_min) + (d.y_max - d.y_min);
  const terrain::Rectangle near{d.x_min - beyond, d.y_min - beyond, d.x_max + beyond, d.y_max + beyond};
  order.reserve(scene.lice.size());
  for (const LouseMark& louse : scene.lice)
    if (near.contains(louse.position.x, louse.position.y)) order.push_back(&louse);
  std::stable_partition(order.begin(), order.end(), [](const LouseMark* louse) { return !louse->is_you; });
  return order;
}

}  // namespace woodlouse::client
