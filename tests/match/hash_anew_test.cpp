// Whatever happens to lice, the hash that is kept from step to step is that of all of them hashed anew, and a
// step makes a link when it did something, and only then.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"
#include "tests/support/big_map_files.h"
#include "tests/support/maps_of_all_kinds.h"

namespace woodlouse::match {
namespace {

bool are_same(const std::vector<state::Louse>& before, std::span<const state::Louse> now) {
  return std::equal(
      before.begin(), before.end(), now.begin(), now.end(),
      [](const state::Louse& a, const state::Louse& b) { return std::memcmp(&a, &b, sizeof a) == 0; });
}

/// Some 150 lice in three blocks; whatever can happen to one happens, most of all beside the blocks' borders,
/// with stretches between in which nothing does.
class Commotion {
 public:
  Commotion(std::shared_ptr<const map::Map> map, physics::InstructionSet set)
      : map_(std::move(map)), set_(set), match_(std::make_unique<Match>(map_, MatchSettings{60, 5})) {
    match_->use(set_);
  }

  void run(int ticks) {
    for (int k = 0; k < 150; ++k) come();
    step();
    for (int tick = 1; tick < ticks; ++tick) {
      if (tick % 60 < 30) happen();
      if (random_.next() % 40 == 0) restore();
      step();
    }
  }

  [[nodiscard]] std::size_t links() const { return links_; }

 private:
  void come() { players_.push_back(match_->join({"a", state::Role::kBot})); }

  /// Beside a border of two blocks, or anybody.
  std::size_t somebody() {
    constexpr std::size_t kBorders[] = {0, 1, 62, 63, 64, 65, 126, 127, 128, 129};
    const std::size_t place = random_.next() % 15;
    return std::min(place < 10 ? kBorders[place] : random_.next() % players_.size(), players_.size() - 1);
  }

  void go(std::size_t place) {
    match_->leave(players_[place]);
    players_.erase(players_.begin() + static_cast<std::ptrdiff_t>(place));
  }

  double part() { return (static_cast<double>(random_.next() % 257) - 128.0) / 128.0; }

  void push(PlayerId player) {
    constexpr std::uint32_t kTicks[] = {0, 1, 2, 5, 40, state::kHeld};
    const std::uint32_t ticks = kTicks[random_.next() % 6];
    const double strength = random_.next() % 3 == 0 ? 0.0 : part();
    state::Thrust thrust;
    switch (random_.next() % 4) {
      case 0:
        break;
      case 1:
        thrust = {state::ThrustKind::kMapVector, {0.7 * strength, 0.7 * part()}};
        break;
      case 2:  // too weak to move anybody: it is counted down at rest
        thrust = {state::ThrustKind::kAlongHeading, {1.0 / 128.0, 0.0}};
        break;
      default:
        thrust = {state::ThrustKind::kAlongHeading, {strength, 0.0}};
    }
    const std::uint64_t wanted = random_.next() % 2 == 0 ? 0 : match_->tick() + random_.next() % 50;
    match_->file({player, ++seq_, thrust, ticks, wanted});
  }

  void happen() {
    const std::uint64_t choice = random_.next() % 24;
    if (choice < 4 && players_.size() < 160) come();
    if (choice >= 4 && choice < 8 && players_.size() > 132) go(somebody());
    if (choice == 8) {  // one for another: as many as before
      go(somebody());
      come();
    }
    if (choice == 9) {  // came and went at once
      come();
      go(players_.size() - 1);
    }
    if (choice == 10) {  // there is nobody any more who could start again
      const std::size_t place = somebody();
      const PlayerId player = players_[place];
      go(place);
      match_->respawn(player);
    }
    if (choice > 10 && choice < 14) match_->respawn(players_[somebody()]);
    if (choice > 12) push(players_[somebody()]);
  }

  void restore() {
    const MatchState state = match_->state();
    REQUIRE(why_not(*map_, match_->settings(), state) == "");
    match_ = Match::restore(map_, match_->settings(), state);
    match_->use(set_);
  }

  void step() {
    const std::vector<state::Louse> before(match_->world().lice().begin(), match_->world().lice().end());
    const std::uint64_t hash = match_->hash();
    const state::HashLink link = match_->link();
    const StepRecord& record = match_->advance();
    const bool is_quiet =
        record.roster.empty() && record.inputs.empty() && are_same(before, match_->world().lice());
    REQUIRE((match_->hash() == hash) == is_quiet);
    REQUIRE((match_->link() == link) == is_quiet);
    if (!is_quiet) {
      REQUIRE(match_->link().previous == hash);
      REQUIRE(match_->link().tick == match_->tick());
      ++links_;
    }
    REQUIRE(match_->hash() == state::state_hash(hasher_, match_->link(), match_->world().lice()));
  }

  std::shared_ptr<const map::Map> map_;
  physics::InstructionSet set_;
  std::unique_ptr<Match> match_;
  core::Random random_{11};
  core::StableHasher hasher_;
  std::vector<PlayerId> players_;
  std::uint32_t seq_ = 0;
  std::size_t links_ = 0;
};

}  // namespace

TEST_CASE("on every kind of ground, whatever happens, the hash is that of all lice hashed anew") {
  const tests::BigMapFiles big("hash_anew");
  constexpr int kTicks = 600;
  std::size_t quiet_maps = 0;
  for (const auto& map : tests::maps_of_all_kinds(big)) {
    for (const auto set : {physics::InstructionSet::kScalar, physics::InstructionSet::kAvx2,
                           physics::InstructionSet::kAvx512}) {
      if (!physics::is_available(set)) continue;
      INFO(map->definition.name << ", " << physics::to_text(set));
      Commotion commotion(map, set);
      commotion.run(kTicks);
      quiet_maps += commotion.links() < kTicks ? 1 : 0;
    }
  }
  CHECK(quiet_maps > 0);
}

}  // namespace woodlouse::match
