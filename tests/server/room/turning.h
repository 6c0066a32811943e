// A room that plays one game after the other, and what tests of it ask.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/room/rotation.h"
#include "shared/map/map_file.h"
#include "tests/server/room/house.h"

namespace woodlouse::server::test {
inline Start game_of(const std::string& map_name, state::Mode mode) {
  const std::string file = std::string(WOODLOUSE_SOURCE_DIR "/maps/") + map_name + ".json";
  auto map = map::load_map(file);
  REQUIRE(map);
  return {*map, std::make_unique<match::Match>(*map, match::MatchSettings{60, 7, mode}), file, {}, {}};
}

/// What was called, of all games; each finishes when the test says so.
struct SeenGames {
  std::vector<std::string> calls;
  std::vector<std::function<void()>> unfinished;
};

class GameWitness final : public TickWatcher {
 public:
  GameWitness(SeenGames& seen, std::string game) : seen_(seen), game_(std::move(game)) {}
  void attach(Announce announce) override { announce_ = std::move(announce); }
  void begin(const match::Match& game) override {
    CHECK(game.tick() == 0);
    CHECK(game.world().lice().empty());  // what a recording begins with has nobody on the way
    seen_.calls.push_back("begin " + game_);
  }
  void finish(const std::string&, std::function<void()> done) override {
    seen_.calls.push_back("finish " + game_);
    seen_.unfinished.push_back(std::move(done));
    announce_({"recording_ended", "late words of " + game_});
  }
  void add_figures(RoomFigures& figures) const override {
    ++(figures.shadow ? *figures.shadow : figures.shadow.emplace()).ticks;
  }

 private:
  SeenGames& seen_;
  std::string game_;
  Announce announce_;
};

/// Table's hill, then volcano without rules; a game is made when the test says so.
class HandmadeRotation final : public Rotation {
 public:
  explicit HandmadeRotation(SeenGames& seen) : seen_(seen) {}
  void prepare(std::function<void(NextGame)> ready) override {
    ++asked;
    ready_ = std::move(ready);
  }
  void make() {
    REQUIRE(ready_ != nullptr);
    NextGame next{
        asked % 2 == 1 ? game_of("volcano", state::Mode::kRoam) : game_of("table", state::Mode::kHill), {}};
    next.watchers.push_back(std::make_unique<GameWitness>(seen_, std::to_string(asked + 1)));
    std::exchange(ready_, nullptr)(std::move(next));
  }
  int asked = 0;

 private:
  SeenGames& seen_;
  std::function<void(NextGame)> ready_;
};

struct Turning : House {
  explicit Turning(SeenGames& seen, HandmadeRotation& rotation, std::uint32_t rounds = 1)
      : House(turning(rounds), game_of("table", state::Mode::kHill), watched(seen), &rotation),
        turns(rotation),
        seen_(seen) {
    room->start([] {});
    tick();
  }
  /// What was not finished holds the room, which must not outlive what it runs on.
  ~Turning() { seen_.unfinished.clear(); }
  static RoomSettings turning(std::uint32_t rounds) {
    RoomSettings result = settings(8);
    result.name = "rotation";
    result.bots = 2;
    result.rounds_a_game = rounds;
    result.adopts_by_name = false;
    return result;
  }
  static Watchers watched(SeenGames& seen) {
    Watchers watchers;
    watchers.push_back(std::make_unique<GameWitness>(seen, "1"));
    return watchers;
  }
  void say(SessionId session, protocol::ClientMessage message) {
    door->submit(session, std::move(message), timekeeper.now());
    settle();
  }
  void push(SessionId session, std::uint32_t seq) {
    protocol::Input input;
    input.seq = seq;
    input.thrust.value = {1.0, 0.0};
    say(session, input);
  }
  void next_game() {
    tick();
    turns.make();
    tick();
  }
  HandmadeRotation& turns;

 private:
  SeenGames& seen_;
};

inline std::string code_of(const protocol::ServerMessage& message) {
  const auto* error = std::get_if<protocol::ErrorMessage>(&message);
  return error == nullptr ? std::string() : error->code;
}

inline std::optional<protocol::Ack> last_ack(const Guest& guest) {
  for (auto at = guest.answers.rbegin(); at != guest.answers.rend(); ++at)
    if (const auto* ack = std::get_if<protocol::Ack>(&*at)) return *ack;
  return std::nullopt;
}

inline bool has(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&part](const std::string& line) { return line.find(part) != std::string::npos; });
}

}  // namespace woodlouse::server::test
