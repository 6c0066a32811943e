// How a room goes on from one game to the next.
#include "server/room/rotation.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <cassert>
#include <memory>
#include <utility>

#include "server/room/room.h"

namespace woodlouse::server {

namespace asio = boost::asio;

bool Room::is_game_over() const {
  if (rotation_ == nullptr) return false;
  if (members_.wants_next()) return true;
  if (const rules::Rules* rules = game_->rules()) return rules->round().number > settings_.rounds_a_game;
  const auto round = static_cast<std::uint64_t>(std::chrono::seconds(kRoamRound).count());
  return game_->tick() >= round * settings_.rounds_a_game * game_->settings().tick_hz;
}

/// Asks for the next one, once; whether it is here, and all have heard the last events of this one.
bool Room::is_next_ready() {
  if (!std::exchange(is_next_asked_, true))
    rotation_->prepare([room = weak_from_this()](NextGame next) {
      const auto self = room.lock();
      if (!self) return;
      auto made = std::make_shared<NextGame>(std::move(next));  // a job can be copied, a game can't
      asio::post(self->strand_, [self, made] { self->next_ = std::move(*made); });
    });
  if (!next_) return false;
  const std::uint64_t most = static_cast<std::uint64_t>(kLastWords.count()) * game_->settings().tick_hz;
  return ++over_ticks_ > most || members_.backlog() == 0;
}

void Room::begin_next() {
  assert(next_ && next_->start.match->settings().tick_hz == game_->settings().tick_hz);
  former_ticks_ += game_->tick();
  const auto former = former_.insert(former_.end(), {std::move(game_), std::move(watchers_)});
  game_ = std::move(next_->start.match);
  watchers_ = std::move(next_->watchers);
  std::unique_ptr<bots::Team> team = std::move(next_->start.team);
  map_file_ = std::move(next_->start.map_file);
  next_.reset();
  is_next_asked_ = false;
  over_ticks_ = 0;
  ++games_;
  say(LogEvent::kGameBegan,
      fmt::format("game {} begins: {} of map {}", games_, state::to_text(game_->settings().mode),
                  game_->map().definition.name));
  begin_watching();
  members_.begin(*game_, std::move(team));
  finish(former->watchers, "the room plays another game", [this, former] {
    for (const auto& watcher : former->watchers) watcher->add_figures(working_);
    former_.erase(former);
    end_if_finished();
  });
}

}  // namespace woodlouse::server
