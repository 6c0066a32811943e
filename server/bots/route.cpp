#include "server/bots/route.h"

#include <algorithm>
#include <variant>

namespace woodlouse::server::bots {
namespace {

constexpr double kThrough = 1.0;  // what it is worth to be through, beside the way that lies behind [s]

/// What is to be taken from the time that counts behind a gate, so that it fits the time before it: the leg
/// behind the next gate did not count until then.
double credit(const Goal& gate, const Goal& next) {
  double most = 0.0;
  for (const double speed : {0.0, 3.0, 6.0, 10.0}) {
    const core::Vec2 velocity = speed * gate.way(), little = 0.1 * gate.way();
    most = std::max(most, next.field->seconds(gate.at + little, velocity) -
                              gate.field->seconds(gate.at - little, velocity));
  }
  return kThrough + most;
}

}  // namespace

Route::Route(const map::RaceMode& mode, const Effort& effort) {
  const std::size_t count = mode.gates.size();
  for (const map::Gate& gate : mode.gates) goals_.push_back(Goal::through(gate));
  if (std::holds_alternative<map::TiledTerrain>(effort.map().definition.terrain)) return;
  moves_.emplace(effort);
  for (const map::Gate& gate : mode.gates)
    alone_.push_back(std::make_unique<GateField>(*moves_, gate, nullptr));
  for (std::size_t k = 0; k < count; ++k) {
    in_order_.push_back(std::make_unique<GateField>(*moves_, mode.gates[k], alone_[(k + 1) % count].get()));
    goals_[k].field = in_order_[k].get();
  }
  for (std::size_t k = 0; k < count; ++k) goals_[k].credit = credit(goals_[k], goals_[(k + 1) % count]);
}

}  // namespace woodlouse::server::bots
