#include "bench/swarm/churn.h"

#include <algorithm>

namespace woodlouse::swarm {

Churn::Churn(boost::asio::io_context& context, const Options& options)
    : context_(context), options_(options), timer_(context) {}

void Churn::start(const std::vector<Bot::Tcp::endpoint>& servers) {
  servers_ = servers;
  begin_ = Bot::Clock::now();
  send_next();
}

void Churn::send_next() {
  if (Bot* bot = find_idle()) {
    bot->start(servers_);
    ++sent_;
  } else {
    ++kept_back_;
  }
  const std::chrono::duration<double> due(static_cast<double>(sent_ + kept_back_) /
                                          options_.churn_per_second);
  timer_.expires_at(begin_ + std::chrono::duration_cast<Bot::Clock::duration>(due));
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) send_next();
  });
}

Bot* Churn::find_idle() {
  const auto idle = std::find_if(bots_.begin(), bots_.end(),
                                 [](const auto& bot) { return bot->state() == Bot::State::kClosed; });
  if (idle != bots_.end()) return idle->get();
  if (bots_.size() == kMost) return nullptr;
  const std::size_t number = bots_.size();
  bots_.push_back(std::make_unique<Bot>(context_, options_, churn_profile(options_, number), number));
  return bots_.back().get();
}

void Churn::stop() {
  timer_.cancel();
  for (const auto& bot : bots_) bot->close();
}

}  // namespace woodlouse::swarm
