// The chosen games in turns, for one room: each is made on a thread of its own, which disks may keep waiting.
#pragma once

#include <boost/asio/thread_pool.hpp>

#include <cstdint>
#include <functional>
#include <vector>

#include "server/chosen_games.h"
#include "server/room/rotation.h"

namespace woodlouse::server {

class GameRotation final : public Rotation {
 public:
  /// A game with who works beside it, of that seed; called on the rotation's thread.
  using Make = std::function<NextGame(const ChosenGame&, std::uint64_t seed)>;

  /// games: two or more; the room has begun with the first. seed: of that; each further game has the next.
  GameRotation(std::vector<ChosenGame> games, std::uint64_t seed, Make make);
  /// Waits for a game that is being made.
  ~GameRotation() override;

  void prepare(std::function<void(NextGame)> ready) override;

 private:
  const std::vector<ChosenGame> games_;
  const std::uint64_t seed_;
  const Make make_;
  std::uint64_t made_ = 1;  ///< the thread's
  boost::asio::thread_pool thread_{1};
};

}  // namespace woodlouse::server
