#include "bench/lab/report/race.h"

#include <sched.h>
#include <time.h>

#include <algorithm>

#include "bench/lab/report/progress.h"

namespace woodlouse::lab {
namespace {

double seconds_on(Clock clock) {
  timespec now{};
  clock_gettime(clock == Clock::kWall ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const Contestant& contestant, std::size_t repeats, Clock clock) {
  const double begin = seconds_on(clock);
  for (std::size_t i = 0; i < repeats; ++i) contestant.run();
  return seconds_on(clock) - begin;
}

}  // namespace

void pin_to_core() {
  const int core = sched_getcpu();
  if (core < 0) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(core), &set);
  sched_setaffinity(0, sizeof set, &set);  // refused: unpinned, only noisier
}

AnyCore::AnyCore() {
  CPU_ZERO(&before_);
  sched_getaffinity(0, sizeof before_, &before_);
  cpu_set_t every;
  CPU_ZERO(&every);
  for (std::size_t core = 0; core < CPU_SETSIZE; ++core) CPU_SET(core, &every);
  sched_setaffinity(0, sizeof every, &every);  // of these, those that the process may have
}

AnyCore::~AnyCore() { sched_setaffinity(0, sizeof before_, &before_); }

std::vector<Timing> race(const std::vector<Contestant>& contestants, Effort effort, const std::string& what,
                         Clock clock) {
  const double block = effort == Effort::kQuick ? 0.0005 : 0.003;  // [s]
  const std::size_t rounds = effort == Effort::kQuick ? 5 : 41;
  constexpr std::size_t kLongBlocks = 10;  // a run of so many takes part in each fourth round: it is a mean
  constexpr std::size_t kSeldom = 4;       // of much by itself
  Progress progress(what, (rounds + 1) * contestants.size());
  std::vector<std::size_t> repeats, every;
  for (const Contestant& c : contestants) {
    c.run();  // warms the caches
    std::size_t n = 1;
    double seconds = seconds_of(c, n, clock);
    while (seconds < block && n < (1u << 24)) {
      n = std::max(n * 2, static_cast<std::size_t>(static_cast<double>(n) *
                                                   std::min(100.0, block / std::max(seconds, 1e-9))));
      seconds = seconds_of(c, n, clock);
    }
    repeats.push_back(n);
    const bool is_long =
        effort == Effort::kFull && n == 1 && seconds > static_cast<double>(kLongBlocks) * block;
    every.push_back(is_long ? kSeldom : 1);
    progress.advance();
  }
  std::vector<std::vector<double>> times(contestants.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      progress.advance();
      if (round % every[i] != 0) continue;
      const double per_run = seconds_of(contestants[i], repeats[i], clock) / static_cast<double>(repeats[i]);
      times[i].push_back(1e9 * per_run / contestants[i].count);
    }
  }
  std::vector<Timing> result;
  for (std::vector<double>& t : times) {
    std::sort(t.begin(), t.end());
    result.push_back({t[t.size() / 2], t.front()});
  }
  return result;
}

}  // namespace woodlouse::lab
