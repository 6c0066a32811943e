#include "bench/swarm/healthy.h"

namespace woodlouse::swarm {
namespace {

constexpr auto kJoinPatience = std::chrono::seconds(10);
constexpr auto kLook = std::chrono::milliseconds(10);

}  // namespace

Healthy::Healthy(const Options& options)
    : work_(context_.get_executor()),
      bots_(make_bots(context_, options, healthy_profiles(options))),
      thread_([this] { context_.run(); }) {}

Healthy::~Healthy() { stop(); }

bool Healthy::join(const std::vector<Bot::Tcp::endpoint>& servers) {
  within([&] {
    for (const auto& bot : bots_) bot->start(servers);
  });
  const auto deadline = Bot::Clock::now() + kJoinPatience;
  while (within([this] { return count(bots_, Bot::State::kJoining); }) != 0 && Bot::Clock::now() < deadline)
    std::this_thread::sleep_for(kLook);
  return within([this] { return count(bots_, Bot::State::kJoined); }) == bots_.size();
}

void Healthy::begin_measuring() {
  within([this] {
    for (const auto& bot : bots_) bot->begin_measuring();
  });
}

Tally Healthy::harvest() {
  return within([this] {
    Tally all;
    for (const auto& bot : bots_) all.add(bot->harvest());
    return all;
  });
}

Tally Healthy::end_measuring() {
  within([this] {
    for (const auto& bot : bots_) bot->end_measuring();
  });
  return harvest();
}

void Healthy::stop() {
  if (!thread_.joinable()) return;
  within([this] {
    for (const auto& bot : bots_) bot->close();
  });
  work_.reset();
  context_.stop();
  thread_.join();
}

}  // namespace woodlouse::swarm
