#include "bench/scenario/play.h"

#include <cassert>
#include <deque>
#include <mutex>
#include <thread>

#include "shared/core/thread_team.h"

namespace woodlouse::scenario {

Play::Play(const Scenario& scenario, physics::InstructionSet set, const std::shared_ptr<core::Team>& team)
    : scenario_(&scenario), set_(set), match_(scenario.map, scenario.settings), seqs_(1, 0) {
  match_.use(set);
  match_.use(team);
}

void Play::apply(const Event& event) {
  switch (event.kind) {
    case Event::Kind::kJoin: {
      [[maybe_unused]] const match::PlayerId player =
          match_.join({"louse " + std::to_string(event.player), state::Role::kBot});
      assert(player == event.player);
      seqs_.resize(event.player + 1, 0);
      return;
    }
    case Event::Kind::kLeave:
      return match_.leave(event.player);
    case Event::Kind::kRespawn:
      return match_.respawn(event.player);
    case Event::Kind::kInput:
      break;
  }
  [[maybe_unused]] const match::Filed filed =
      match_.file({event.player, ++seqs_[event.player], event.thrust, event.ticks, 0});
  assert(filed.outcome == match::Filed::Outcome::kFiled);  // the reader let no other pass
}

void Play::advance(std::uint64_t count) {
  for (; count != 0 && !is_done(); --count) {
    const auto& events = scenario_->events;
    for (; next_event_ < events.size() && events[next_event_].step == match_.tick(); ++next_event_) {
      apply(events[next_event_]);
    }
    last_step_ = &match_.advance();
    for (const rules::Event& event : last_step_->events) rulings_.push_back(to_text(event));
    if (match_.tick() == scenario_->goldens[hashes_.size()].tick) hashes_.push_back(match_.hash());
  }
}

void play_all(std::span<const std::unique_ptr<Play>> plays, std::size_t threads) {
  constexpr std::uint64_t kTurn = 7;  // steps; short, so that the turns mix
  std::mutex mutex;
  std::deque<Play*> waiting;
  for (const auto& play : plays) waiting.push_back(play.get());
  const auto work = [&] {
    std::unique_lock lock(mutex);
    while (!waiting.empty()) {
      Play* const play = waiting.front();
      waiting.pop_front();
      lock.unlock();
      play->advance(kTurn);
      lock.lock();
      if (!play->is_done()) waiting.push_back(play);
    }
  };
  const auto work_too = [&work](std::size_t) { work(); };
  std::vector<std::jthread> others;
  core::start_threads(others, 1, threads, work_too);
  work();
}

}  // namespace woodlouse::scenario
