#include "shared/rules/forage.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "shared/core/stable_hash.h"
#include "shared/rules/summits.h"

namespace woodlouse::rules {
namespace {

constexpr std::uint64_t kRefill = 3, kChain = 4, kHarvest = 30;                    // [s]
constexpr double kUnits = 1024.0;                                                  // in a metre
constexpr double kMargin = 1.0, kFromLice = 2.5, kFromCrumbs = 1.5, kReach = 1.0;  // [m]
constexpr double kUsualSpeed = 30.0;                                               // [m/s]
constexpr double kSlack = 1e-3;                                                    // [m] for roundings
constexpr double kSteep = 1.5;  // of what full thrust holds on a slope
constexpr int kTries = 16;
constexpr std::uint8_t kOnGround = 1, kOnSummit = 3, kLongestChain = 3;
constexpr std::int64_t kMaxScore = std::int64_t{1} << 53;

std::int64_t floor_of(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) > value ? whole - 1 : whole;
}

/// The first and the last unit of an axis, `margin` within its ends, or a quarter of it.
std::pair<std::int64_t, std::int64_t> units_of(double low, double high, double margin, bool wraps) {
  const double inset = wraps ? 0.0 : std::min(margin, 0.25 * (high - low));
  const std::int64_t first = -floor_of(-(kUnits * (low + inset)));
  std::int64_t last = floor_of(kUnits * (high - inset));
  if (wraps && static_cast<double>(last) >= kUnits * high) --last;
  return {first, std::max(first, last)};  // a map below a unit has one
}

/// The least part of a way from `from` along `way` after which it is within the radius of the origin.
std::optional<double> reach(core::Vec2 from, core::Vec2 way, double radius) {
  const double outside = core::dot(from, from) - radius * radius;
  if (outside <= 0.0) return 0.0;
  const double b = core::dot(way, from);
  if (!(b < 0.0)) return std::nullopt;
  const double under = b * b - core::dot(way, way) * outside;
  if (!(under >= 0.0)) return std::nullopt;
  const double part = outside / (std::sqrt(under) - b);
  return part <= 1.0 ? std::optional(part) : std::nullopt;
}

bool is_nearer(core::Vec2 way, double distance) { return core::dot(way, way) < distance * distance; }

core::Random random_of(std::uint64_t hash, std::uint64_t slot) {
  const std::array<std::uint64_t, 2> words{hash, slot};
  const auto bytes = std::bit_cast<std::array<char, sizeof words>>(words);
  return core::Random(core::stable_hash({bytes.data(), bytes.size()}));
}

}  // namespace

Forage::Forage(const map::Map& map, std::uint32_t tick_hz)
    : Rules(state::Mode::kForage, map, tick_hz,
            {kCountdown * tick_hz, std::uint64_t{map.definition.modes.forage->round_s} * tick_hz,
             std::uint64_t{map.definition.modes.forage->podium_s} * tick_hz}),
      mode_(*map.definition.modes.forage),
      images_(images_of(map)),
      harvest_ticks_(std::min(ticks_of(kHarvest), ticks_of(mode_.round_s) / 3)),
      slots_(mode_.crumbs),
      usual_way_(kUsualSpeed / tick_hz),
      map_of_crumbs_(map.terrain->domain(), images_, mode_.radius + usual_way_ + kSlack) {
  assert(mode_.crumbs >= 1 && mode_.crumbs <= map::kMaxCrumbs && mode_.summits <= mode_.crumbs);
  const terrain::Rectangle& domain = map.terrain->domain();
  std::tie(low_.x, high_.x) = units_of(domain.x_min, domain.x_max, kMargin, images_.wraps());
  std::tie(low_.y, high_.y) = units_of(domain.y_min, domain.y_max, kMargin, images_.wraps());
  for (const core::Vec2 summit : summits_of(map.definition, kMargin)) summits_.push_back(place_at(summit));
}

bool Forage::is_within(Place place) const {
  return place.x >= low_.x && place.x <= high_.x && place.y >= low_.y && place.y <= high_.y;
}

Forage::Place Forage::place_at(core::Vec2 position) const {
  return {std::clamp(floor_of(kUnits * position.x), low_.x, high_.x),
          std::clamp(floor_of(kUnits * position.y), low_.y, high_.y)};
}

core::Vec2 Forage::position(Place place) const {
  const terrain::Rectangle& domain = map().terrain->domain();
  return {std::clamp(static_cast<double>(place.x) / kUnits, domain.x_min, domain.x_max),
          std::clamp(static_cast<double>(place.y) / kUnits, domain.y_min, domain.y_max)};
}

Standing Forage::standing(state::LouseId louse) const {
  const Player* player = players_.find(louse);
  return player != nullptr ? Standing{.score = player->score} : Standing{};
}

std::vector<TableRow> Forage::table() const {
  std::vector<const Player*> order;
  for (const Player& player : players_) order.push_back(&player);
  std::sort(order.begin(), order.end(), [](const Player* a, const Player* b) {
    return std::tie(b->score, a->last, a->id) < std::tie(a->score, b->last, b->id);
  });
  std::vector<TableRow> rows;
  for (const Player* player : order) rows.push_back({player->id, player->score});
  return rows;
}

ShownCrumb Forage::crumb(std::uint32_t slot) const {
  assert(slot < slots_.size());
  const Slot& own = slots_[slot];
  return {slot, own.value != 0 ? position(own.place) : core::Vec2{}, own.value};
}

std::vector<ShownCrumb> Forage::shown_crumbs() const {
  std::vector<ShownCrumb> all;
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) all.push_back(crumb(slot));
  return all;
}

std::vector<ShownCrumb> Forage::crumbs() const {
  std::vector<ShownCrumb> all;
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].value != 0) all.push_back(crumb(slot));
  }
  return all;
}

std::uint64_t Forage::harvest() const {
  return round().phase == Phase::kPlay && harvest_ticks_ > 0 ? round().until - harvest_ticks_ : 0;
}

void Forage::on_join(state::LouseId louse) {
  Player player;
  player.id = louse;
  players_.add(player);
}

void Forage::on_leave(state::LouseId louse) { players_.remove(louse); }

void Forage::on_round(Step& step) {
  for (Player& player : players_) player = {player.id, 0, 0, 0};
  slots_.assign(slots_.size(), {});
  is_map_stale_ = true;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) fill(slot, step);
}

void Forage::judge(Step& step) {
  changed_ = 0;
  if (round().phase != Phase::kPlay || players_.empty()) return;
  if (std::exchange(is_map_stale_, false)) map_crumbs();
  claim_all(step);
  if (claimed_ != 0) eat_claimed(step);
  const std::uint64_t now = step.tick + 1;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].value == 0 && slots_[slot].due != 0 && now >= slots_[slot].due) fill(slot, step);
  }
  if (harvest() == now) say({EventKind::kHarvest, 0, now * kMomentsPerTick, {}});
}

void Forage::before_step(const physics::World& world) {
  const std::span<const state::Louse> lice = world.lice();
  starts_.resize(lice.size());
  for (std::size_t k = 0; k < lice.size(); ++k) starts_[k] = lice[k].position;
}

void Forage::map_crumbs() {
  map_of_crumbs_.clear();
  lying_ = 0;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].value == 0) continue;
    positions_[slot] = position(slots_[slot].place);
    map_of_crumbs_.add(static_cast<std::uint32_t>(slot), positions_[slot]);
    lying_ |= std::uint64_t{1} << slot;
  }
}

/// Who eats what, all by the points before the step.
void Forage::claim_all(const Step& step) {
  claimed_ = 0;
  const std::span<const state::Louse> lice = step.world.lice();
  assert(starts_.size() == lice.size());
  auto player = players_.begin();
  for (std::size_t k = 0; k < lice.size(); ++k) {
    while (player != players_.end() && player->id < lice[k].id) ++player;
    if (player == players_.end()) break;
    if (player->id == lice[k].id) claim(starts_[k], lice[k], *player);
  }
}

inline void Forage::claim(core::Vec2 from, const state::Louse& louse, Player& player) {
  const core::Vec2 way = images_.nearest(from, louse.position) - from;
  std::uint64_t candidates = is_nearer(way, usual_way_) ? map_of_crumbs_.near(from) : lying_;
  for (; candidates != 0; candidates &= candidates - 1) {
    const auto slot = static_cast<std::size_t>(std::countr_zero(candidates));
    const std::optional<double> part =
        reach(from - images_.nearest(from, positions_[slot]), way, mode_.radius);
    if (!part) continue;
    if (louse.phase == state::Phase::kFlying && louse.flight_z - ground_at(louse.position).z > kReach) return;
    const Claim own{&player, static_cast<std::uint64_t>(static_cast<double>(kMomentsPerTick) * *part)};
    const auto key = [](const Claim& claim) {
      return std::tuple(claim.part, claim.player->score, claim.player->id);
    };
    Claim& first = claims_[slot];
    const std::uint64_t bit = std::uint64_t{1} << slot;
    if ((claimed_ & bit) == 0 || key(own) < key(first)) first = own;
    claimed_ |= bit;
  }
}

/// One after the other: what somebody eats first makes the chain of what he eats next.
void Forage::eat_claimed(const Step& step) {
  std::vector<std::size_t> order;
  for (std::uint64_t rest = claimed_; rest != 0; rest &= rest - 1)
    order.push_back(static_cast<std::size_t>(std::countr_zero(rest)));
  assert(!order.empty() && order.back() < slots_.size());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return claims_[a].part < claims_[b].part; });
  for (const std::size_t slot : order) {
    eat(slot, *claims_[slot].player, step.tick * kMomentsPerTick + claims_[slot].part);
    slots_[slot] = {{}, 0, step.tick + 1 + ticks_of(kRefill)};
    is_map_stale_ = true;
  }
}

void Forage::eat(std::size_t slot, Player& player, Moment moment) {
  const bool goes_on = player.chain > 0 && moment - player.last <= ticks_of(kChain) * kMomentsPerTick;
  player.chain = static_cast<std::uint8_t>(goes_on ? std::min<int>(kLongestChain, player.chain + 1) : 1);
  const bool is_harvest = harvest() != 0 && moment >= harvest() * kMomentsPerTick;
  const std::int64_t value = slots_[slot].value;
  player.score = std::min(kMaxScore, player.score + value * player.chain * (is_harvest ? 2 : 1));
  player.last = moment;
  changed_ |= std::uint64_t{1} << slot;
  say({EventKind::kCrumb,
       player.id,
       moment,
       {static_cast<std::int64_t>(slot), value, player.chain, player.score}});
  note_change();
}

/// A new crumb in that slot, where none lies.
void Forage::fill(std::size_t slot, const Step& step) {
  core::Random random = random_of(step.hash, slot);
  const bool is_high = random.next() % mode_.crumbs < mode_.summits;
  const std::vector<Place> summits = is_high ? free_summits(step.world) : std::vector<Place>();
  Slot next;
  next.value = summits.empty() ? kOnGround : kOnSummit;
  next.place = summits.empty() ? ground_for(random, step.world) : summits[random.next() % summits.size()];
  slots_[slot] = next;
  is_map_stale_ = true;
  changed_ |= std::uint64_t{1} << slot;
  note_change();
}

bool Forage::has_louse_near(core::Vec2 at, const physics::World& world) const {
  const auto lice = world.lice();
  return std::any_of(lice.begin(), lice.end(), [&](const state::Louse& louse) {
    return is_nearer(images_.nearest(at, louse.position) - at, kFromLice);
  });
}

/// Those without a crumb and a louse.
std::vector<Forage::Place> Forage::free_summits(const physics::World& world) const {
  std::vector<Place> free;
  for (const Place summit : summits_) {
    const bool is_taken = std::any_of(slots_.begin(), slots_.end(), [&](const Slot& slot) {
      return slot.value != 0 && slot.place == summit;
    });
    if (!is_taken && !has_louse_near(position(summit), world)) free.push_back(summit);
  }
  return free;
}

/// The first good one of a few, or the last.
Forage::Place Forage::ground_for(core::Random& random, const physics::World& world) const {
  const auto on_axis = [&](std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(high - low + 1));
  };
  Place place;
  for (int k = 0; k < kTries; ++k) {
    place.x = on_axis(low_.x, high_.x);
    place.y = on_axis(low_.y, high_.y);
    if (is_good(place, world)) break;
  }
  return place;
}

/// Away from lice and crumbs, and not too steep.
bool Forage::is_good(Place place, const physics::World& world) const {
  const core::Vec2 at = position(place);
  for (const Slot& slot : slots_) {
    if (slot.value != 0 && is_nearer(images_.nearest(at, position(slot.place)) - at, kFromCrumbs))
      return false;
  }
  const state::Parameters& physics = world.parameters();
  const double steepest = kSteep * physics.thrust_max / physics.gravity;
  const terrain::SurfaceSample ground = ground_at(at);
  const double slope2 = ground.zx * ground.zx + ground.zy * ground.zy;
  if (physics.thrust_max > 0.0 && !(slope2 <= steepest * steepest)) return false;
  return !has_louse_near(at, world);
}

void Forage::write(StateWriter& out) const {
  for (const Slot& slot : slots_) out.put(slot.place.x, slot.place.y, slot.value, slot.due);
  out.put(static_cast<std::uint32_t>(players_.size()));
  for (const Player& player : players_) out.put(player.id, player.chain, player.score, player.last);
}

bool Forage::read(StateReader& in, std::span<const state::LouseId> ids) {
  is_map_stale_ = true;
  for (Slot& slot : slots_) {
    slot.place = {in.get_signed(), in.get_signed()};
    slot.value = in.get<std::uint8_t>();
    slot.due = in.get<std::uint64_t>();
    const bool fits = slot.value == 0 ? slot.place == Place{}
                                      : (slot.value == kOnGround || slot.value == kOnSummit) &&
                                            is_within(slot.place) && slot.due == 0;
    if (!fits) return false;
  }
  players_.clear();
  const std::size_t count = in.get_count(4 + 1 + 8 + 8);
  for (std::size_t k = 0; k < count; ++k) {
    Player player;
    player.id = in.get<std::uint32_t>();
    player.chain = in.get<std::uint8_t>();
    player.score = in.get_signed();
    player.last = in.get<std::uint64_t>();
    if (k >= ids.size() || player.id != ids[k] || player.chain > kLongestChain || player.score < 0 ||
        player.score > kMaxScore)
      return false;
    players_.add(player);
  }
  return count == ids.size();
}

}  // namespace woodlouse::rules
