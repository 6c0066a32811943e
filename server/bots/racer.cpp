#include "server/bots/racer.h"

#include <array>
#include <cstddef>

namespace woodlouse::server::bots {
namespace {

constexpr double kNearer = 0.5;  // what counts as nearer to a gate [s]

}  // namespace

Player::Choice Racer::choose(const Scene& scene, Foresight& foresight) {
  const std::uint32_t next = scene.seen.gates[scene.own];
  if (next != gate_ || since_ == 0) {
    gate_ = next;
    since_ = scene.tick;
    patience_.begin(scene.tick);
  }
  if (static_cast<double>(scene.tick - since_) * scene.tick_s > kGivesUpAfter) {
    since_ = 0;
    return {{}, true};
  }
  std::array<Goal, 4> goals;
  for (std::size_t k = 0; k < goals.size(); ++k) goals[k] = route_.goal(next + k);
  const Foresight::Question question = ask(scene, goals);
  const state::Louse& now = foresight.now(question);
  const double seconds = goals[0].field != nullptr ? goals[0].field->seconds(now.position, now.velocity)
                                                   : foresight.effort().seconds_to(now, goals[0]);
  if (patience_.is_out(scene.tick, scene.tick_s, seconds, kNearer, random()))
    return {foresight.swing(question)};
  return {foresight.best_push(question)};
}

}  // namespace woodlouse::server::bots
