// Who leaves a log, or closes his line, while messages come: libnats reads on a thread of its own, and looks
// at what is left.
//
// Usage: woodlouse-unfollow CLUSTER.json ROUNDS
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include "server/cluster/cluster_settings.h"
#include "server/cluster/nats_link.h"

using namespace woodlouse::server;

namespace {

constexpr long kRoundsOfALink = 50;
constexpr std::uint64_t kBehind = 20;  // messages, so that some are on their way at once

std::unique_ptr<NatsLink> link_to(const ClusterSettings& settings, const char* purpose) {
  auto link = NatsLink::open(settings, purpose, {});
  if (link) return std::move(*link);
  std::cerr << link.error().text() << '\n';
  std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: woodlouse-unfollow CLUSTER.json ROUNDS\n";
    return 2;
  }
  auto settings = read_cluster_settings(argv[1]);
  if (!settings) {
    std::cerr << settings.error().text() << '\n';
    return 2;
  }
  settings->host = "unfollow";
  const auto writing = link_to(*settings, "writes");
  const std::jthread writer([&](const std::stop_token& stop) {
    const std::string bytes(300, 'x');
    while (!stop.stop_requested()) {
      static_cast<void>(writing->publish(settings->log_subject(), bytes));
      static_cast<void>(writing->publish(settings->beat_subject("x"), bytes));
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  });
  std::atomic<long> read{0};
  const auto count = [&read](const std::string&, const std::string&, std::uint64_t) { ++read; };
  std::unique_ptr<NatsLink> link;
  const long rounds = std::atol(argv[2]);
  for (long round = 0; round < rounds; ++round) {
    if (round % kRoundsOfALink == 0) {
      link = link_to(*settings, "reads");
      static_cast<void>(link->subscribe(settings->beat_subject("*"), count));
    }
    const auto state = link->stream_state();
    if (!state || !link->follow(state->last > kBehind ? state->last - kBehind : 1, count)) continue;
    std::this_thread::sleep_for(std::chrono::milliseconds(2 + round % 5));
    link->unfollow();
  }
  std::cout << rounds << " rounds, " << read << " messages read\n";
  return read > rounds ? 0 : 1;
}
