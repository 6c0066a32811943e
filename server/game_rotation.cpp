#include "server/game_rotation.h"

#include <boost/asio/post.hpp>

#include <cassert>
#include <utility>

namespace woodlouse::server {

GameRotation::GameRotation(std::vector<ChosenGame> games, std::uint64_t seed, Make make)
    : games_(std::move(games)), seed_(seed), make_(std::move(make)) {
  assert(games_.size() >= 2 && make_ != nullptr);
}

GameRotation::~GameRotation() {
  thread_.stop();
  thread_.join();
}

void GameRotation::prepare(std::function<void(NextGame)> ready) {
  boost::asio::post(thread_, [this, ready = std::move(ready)] {
    const std::uint64_t number = made_++;
    ready(make_(games_[number % games_.size()], seed_ + number));
  });
}

}  // namespace woodlouse::server
