// The fence that every cluster stands on, tried on real servers: several writers publish with the same
// expectation at once. More than one accepted: that version of NATS can't carry a cluster.
//
// Usage: woodlouse-race CLUSTER.json ROUNDS WRITERS
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/cluster/cluster_settings.h"
#include "server/cluster/nats_link.h"

using namespace woodlouse::server;

namespace {

constexpr auto kAnswerWithin = std::chrono::seconds(12);  // a log without its leader takes 5 s

struct Answers {
  std::atomic<int> stored{0}, refused{0};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: woodlouse-race CLUSTER.json ROUNDS WRITERS\n";
    return 2;
  }
  auto settings = read_cluster_settings(argv[1]);
  if (!settings) {
    std::cerr << settings.error().text() << '\n';
    return 2;
  }
  settings->host = "race";
  const long rounds = std::atol(argv[2]), writers = std::atol(argv[3]);
  auto answers = std::make_shared<Answers>();
  std::vector<std::unique_ptr<NatsLink>> links;
  for (long k = 0; k < writers; ++k) {
    ClusterSettings own = *settings;
    std::swap(own.nats.front(),
              own.nats[static_cast<std::size_t>(k) % own.nats.size()]);  // each by another node
    auto link = NatsLink::open(own, "race",
                               {[answers](std::uint64_t) { ++answers->stored; },
                                [answers](const std::string&) { ++answers->refused; },
                                {}});
    if (!link) {
      std::cerr << link.error().text() << '\n';
      return 2;
    }
    links.push_back(std::move(*link));
  }
  long twice = 0, none = 0, holes = 0;
  for (long round = 0; round < rounds; ++round) {
    const auto last = links.front()->last();
    if (!last) {  // no leader now
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      --round;
      continue;
    }
    answers->stored = answers->refused = 0;
    std::atomic<long> ready{0};
    std::vector<std::jthread> threads;
    for (const auto& link : links)
      threads.emplace_back([&, writer = link.get()] {
        ++ready;
        while (ready < writers) {
        }
        if (!writer->append("x", last->sequence)) ++answers->refused;
      });
    threads.clear();
    const auto until = std::chrono::steady_clock::now() + kAnswerWithin;
    while (answers->stored + answers->refused < writers && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    twice += answers->stored > 1 ? 1 : 0;
    none += answers->stored == 0 ? 1 : 0;
    const auto after = links.front()->stream_state();
    if (after && after->last > last->sequence + 1) ++holes;
  }
  std::cout << rounds << " rounds of " << writers << " writers: more than one accepted in " << twice
            << ", more than one stored in " << holes << ", none acknowledged in " << none << '\n';
  return twice == 0 && holes == 0 ? 0 : 1;
}
