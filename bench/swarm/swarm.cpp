#include "bench/swarm/swarm.h"

#include <sys/resource.h>

#include <algorithm>

namespace woodlouse::swarm {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kBetweenJoins = 2ms;  // a crowd that comes in the same millisecond overruns the listen queue
constexpr auto kJoinPatience = 15s;
constexpr auto kSettling = 1s;  // the first key of each is sent out of turn
constexpr auto kLeavePatience = 3s;

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

Swarm::Swarm(const Options& options) : options_(options), context_(1), work_(context_.get_executor()) {
  for (std::size_t i = 0; i < options.bots; ++i)
    bots_.push_back(std::make_unique<Bot>(context_, options_, i));
}

std::size_t Swarm::count(Bot::State state) const {
  return static_cast<std::size_t>(
      std::count_if(bots_.begin(), bots_.end(), [state](const auto& bot) { return bot->state() == state; }));
}

template <typename Done>
void Swarm::run_until(Clock::duration limit, Done done) {
  const auto deadline = Clock::now() + limit;
  while (!done() && Clock::now() < deadline) context_.run_one_until(std::min(deadline, Clock::now() + 50ms));
}

core::Expected<std::chrono::duration<double>> Swarm::run() {
  boost::system::error_code error;
  boost::asio::ip::tcp::resolver resolver(context_);
  const auto endpoints = resolver.resolve(options_.host, options_.port, error);
  if (error) return core::fail(options_.host + ":" + options_.port, error.message(), "check the address");

  for (const auto& bot : bots_) {
    bot->start(endpoints);
    run_until(kBetweenJoins, [] { return false; });
  }
  run_until(kJoinPatience, [this] { return count(Bot::State::kJoining) == 0; });
  if (count(Bot::State::kJoined) == 0) {
    const std::string& loss = bots_.front()->loss();
    return core::fail(options_.host + ":" + options_.port,
                      "no bot could join: " + (loss.empty() ? "no answer" : loss),
                      "is woodlouse-server running there?");
  }
  run_until(kSettling, [] { return false; });

  for (const auto& bot : bots_) bot->begin_measuring();
  const auto begin = Clock::now();
  const double cpu_before = cpu_seconds();
  run_until(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.seconds)),
            [this] { return count(Bot::State::kJoined) == 0; });
  const std::chrono::duration<double> measured = Clock::now() - begin;
  own_cpu_seconds_ = cpu_seconds() - cpu_before;
  for (const auto& bot : bots_) {
    bot->end_measuring();
    bot->leave();
  }
  run_until(kLeavePatience, [this] { return count(Bot::State::kLeaving) == 0; });
  for (const auto& bot : bots_) bot->close();
  return measured;
}

}  // namespace woodlouse::swarm
