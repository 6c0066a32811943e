// Rules of play with their world, without a match: lice are put where a test wants them.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/core/stable_hash.h"
#include "shared/map/map_file.h"
#include "shared/map/map_world.h"
#include "shared/rules/rules.h"

namespace woodlouse::tests {

/// 40 m of level ground without drag and friction, the origin in its middle.
inline std::string level_map(const std::string& more, const std::string& physics = "") {
  std::string heights;
  for (int row = 0; row < 5; ++row) heights += row == 0 ? "[0,0,0,0,0]" : ",[0,0,0,0,0]";
  return R"({"name":"m","terrain":{"origin":[-20,-20],"spacing":10,"heights":[)" + heights +
         R"(]},"physics":{"drag":0,"friction":0)" + physics + "}," + more + "}";
}

inline std::shared_ptr<const map::Map> map_of(const std::string& text) {
  const auto map = map::parse_map(text, "m.json", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

/// Rules: the mode's.
template <typename Rules>
class Table {
 public:
  Table(const std::string& text, state::Mode mode, std::uint32_t tick_hz = 60)
      : map_(map_of(text)),
        world_(map::make_world(*map_, 1.0 / tick_hz, mode)),
        rules_(rules::Rules::make(mode, *map_, tick_hz)) {}

  Rules& rules() { return static_cast<Rules&>(*rules_); }
  physics::World& world() { return world_; }
  [[nodiscard]] const map::Map& map() const { return *map_; }
  [[nodiscard]] std::uint64_t tick() const { return tick_; }

  void join(state::LouseId id, core::Vec2 position, core::Vec2 velocity = {}) {
    rules_->join(id);
    put(id, position, velocity);
  }
  /// Replaces the louse, or makes it.
  void put(state::LouseId id, core::Vec2 position, core::Vec2 velocity = {}) {
    world_.erase(id);
    state::Louse louse;
    louse.id = id;
    louse.position = position;
    louse.velocity = velocity;
    world_.insert(louse);
  }
  void step() {
    rules_->before_step(world_);
    world_.step();
    rules_->after_step(world_, tick_, hash());
    ++tick_;
    for (const rules::Event& event : rules_->events()) said_.push_back(event);
  }
  void step(std::uint64_t steps) {
    for (std::uint64_t k = 0; k < steps; ++k) step();
  }
  /// Up to the beginning of play.
  void begin() {
    while (rules_->round().phase != rules::Phase::kPlay) step();
    said_.clear();
  }
  /// As a match's, of this tick.
  [[nodiscard]] std::uint64_t hash() const { return core::stable_hash(std::to_string(tick_)); }
  /// Goes on from a state of other rules at this tick. The lice stay.
  [[nodiscard]] bool restore(std::string_view state, const std::vector<state::LouseId>& ids) {
    rules_ = rules::Rules::make(rules_->mode(), *map_, 60);
    return rules_->restore(state, ids);
  }

  /// What was said of a kind, since the last call.
  std::vector<rules::Event> said(rules::EventKind kind) {
    std::vector<rules::Event> found;
    for (const rules::Event& event : said_) {
      if (event.kind == kind) found.push_back(event);
    }
    std::erase_if(said_, [&](const rules::Event& event) { return event.kind == kind; });
    return found;
  }

 private:
  std::shared_ptr<const map::Map> map_;
  physics::World world_;
  std::unique_ptr<rules::Rules> rules_;
  std::uint64_t tick_ = 0;
  std::vector<rules::Event> said_;
};

}  // namespace woodlouse::tests
