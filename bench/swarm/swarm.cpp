#include "bench/swarm/swarm.h"

#include <algorithm>

#include "bench/swarm/cpu_time.h"
#include "bench/swarm/servers.h"

namespace woodlouse::swarm {
namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 10ms;           // between looks at all clients
constexpr auto kBetweenJoins = 100us;  // at least: those who are in have to be read meanwhile
constexpr auto kJoinPatience = 15s;
constexpr auto kSettling = 1s;  // the first key of each is sent out of turn
constexpr auto kAway = 1s;      // of those whose connections are cut
constexpr auto kLeavePatience = 3s;

std::chrono::steady_clock::duration in_seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

Swarm::Swarm(const Options& options)
    : options_(options),
      context_(1),
      work_(context_.get_executor()),
      bots_(make_bots(context_, options, load_profiles(options))),
      churn_(context_, options),
      healthy_(options) {}

void Swarm::run_for(Clock::duration duration) {
  run_until(duration, [] { return false; });
}

template <typename Done>
void Swarm::run_until(Clock::duration limit, Done done) {
  const auto deadline = Clock::now() + limit;
  while (!done() && Clock::now() < deadline) context_.run_until(std::min(deadline, Clock::now() + kLook));
}

core::Expected<std::chrono::duration<double>> Swarm::run() {
  const auto servers = find_servers(context_, options_);
  if (!servers) return tl::unexpected(servers.error());
  if (const auto in = let_healthy_in(*servers); !in) return tl::unexpected(in.error());
  let_in(*servers);
  if (!bots_.empty() && healthy_.bots().empty() && count(bots_, Bot::State::kJoined) == 0) {
    const std::string& loss = bots_.front()->loss();
    return core::fail(options_.host + ":" + options_.port,
                      "no bot could join: " + (loss.empty() ? "no answer" : loss),
                      "is woodlouse-server running there?");
  }
  const auto measured = measure();
  send_home();
  return measured;
}

core::Expected<void> Swarm::let_healthy_in(const std::vector<Bot::Tcp::endpoint>& servers) {
  if (healthy_.bots().empty()) return {};
  if (!healthy_.join(servers))
    return core::fail(options_.host + ":" + options_.port, "the healthy clients could not join",
                      "is woodlouse-server running there, with room for them?");
  run_for(kSettling);
  healthy_.begin_measuring();
  run_for(in_seconds(options_.before_seconds));
  healthy_tallies_.before = healthy_.harvest();
  return {};
}

void Swarm::let_in(const std::vector<Bot::Tcp::endpoint>& servers) {
  const auto begin = Clock::now();
  if (options_.churn_per_second > 0.0) churn_.start(servers);
  for (std::size_t i = 0; i < bots_.size(); ++i) {
    const auto due = begin + in_seconds(static_cast<double>(i) / options_.joins_per_second);
    context_.run_until(std::max(due, Clock::now() + kBetweenJoins));
    bots_[i]->start(servers);
  }
  run_until(kJoinPatience, [this] { return count(bots_, Bot::State::kJoining) == 0; });
  joining_seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
  run_for(kSettling);
  if (!healthy_.bots().empty()) healthy_tallies_.coming = healthy_.harvest();
}

std::chrono::duration<double> Swarm::measure() {
  for (const auto& bot : bots_) bot->begin_measuring();
  const auto begin = Clock::now();
  const double cpu_before = cpu_seconds();
  const auto are_lost = [this] {
    return healthy_.bots().empty() && !bots_.empty() && options_.churn_per_second == 0.0 &&
           count(bots_, Bot::State::kJoined) == 0;
  };
  if (options_.resume) {
    run_for(in_seconds(0.5 * options_.seconds));
    for (const auto& bot : bots_)
      if (bot->profile().resumes) bot->cut(kAway);
    run_for(begin + in_seconds(options_.seconds) - Clock::now());
  } else {
    run_until(in_seconds(options_.seconds), are_lost);
  }
  const std::chrono::duration<double> measured = Clock::now() - begin;
  own_cpu_seconds_ = cpu_seconds() - cpu_before;
  if (!healthy_.bots().empty()) healthy_tallies_.lasts = healthy_.end_measuring();
  return measured;
}

void Swarm::send_home() {
  churn_.stop();
  for (const auto& bot : bots_) {
    bot->end_measuring();
    bot->leave();
  }
  run_until(kLeavePatience, [this] { return count(bots_, Bot::State::kLeaving) == 0; });
  for (const auto& bot : bots_) bot->close();
  healthy_.stop();
}

}  // namespace woodlouse::swarm
