// A room that plays one game after the other.
#include "server/room/rotation.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/map/map_file.h"
#include "tests/server/room/house.h"

namespace woodlouse::server::test {
namespace {

Start game_of(const std::string& map_name, state::Mode mode) {
  const std::string file = std::string(WOODLOUSE_SOURCE_DIR "/maps/") + map_name + ".json";
  auto map = map::load_map(file);
  REQUIRE(map);
  return {*map, std::make_unique<match::Match>(*map, match::MatchSettings{60, 7, mode}), file, {}, {}};
}

/// What was called, of all games; each finishes when the test says so.
struct Seen {
  std::vector<std::string> calls;
  std::vector<std::function<void()>> unfinished;
};

class Witness final : public TickWatcher {
 public:
  Witness(Seen& seen, std::string game) : seen_(seen), game_(std::move(game)) {}
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

 private:
  Seen& seen_;
  std::string game_;
  Announce announce_;
};

/// Table's hill, then volcano without rules; a game is made when the test says so.
class Turns final : public Rotation {
 public:
  explicit Turns(Seen& seen) : seen_(seen) {}
  void prepare(std::function<void(NextGame)> ready) override {
    ++asked;
    ready_ = std::move(ready);
  }
  void make() {
    REQUIRE(ready_ != nullptr);
    NextGame next{
        asked % 2 == 1 ? game_of("volcano", state::Mode::kRoam) : game_of("table", state::Mode::kHill), {}};
    next.watchers.push_back(std::make_unique<Witness>(seen_, std::to_string(asked + 1)));
    std::exchange(ready_, nullptr)(std::move(next));
  }
  int asked = 0;

 private:
  Seen& seen_;
  std::function<void(NextGame)> ready_;
};

struct Turning : House {
  explicit Turning(Seen& seen, Turns& rotation, std::uint32_t rounds = 1)
      : House(turning(rounds), game_of("table", state::Mode::kHill), watched(seen), &rotation),
        turns(rotation) {
    room->start([] {});
    tick();
  }
  static RoomSettings turning(std::uint32_t rounds) {
    RoomSettings result = settings(8);
    result.name = "rotation";
    result.bots = 2;
    result.rounds_a_game = rounds;
    result.adopts_by_name = false;
    return result;
  }
  static Watchers watched(Seen& seen) {
    Watchers watchers;
    watchers.push_back(std::make_unique<Witness>(seen, "1"));
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
  Turns& turns;
};

std::string code_of(const protocol::ServerMessage& message) {
  const auto* error = std::get_if<protocol::ErrorMessage>(&message);
  return error == nullptr ? std::string() : error->code;
}

std::optional<protocol::Ack> last_ack(const Guest& guest) {
  for (auto at = guest.answers.rbegin(); at != guest.answers.rend(); ++at)
    if (const auto* ack = std::get_if<protocol::Ack>(&*at)) return *ack;
  return std::nullopt;
}

bool has(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&part](const std::string& line) { return line.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("most of the players vote, and everybody is in the next game") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann")), ben = house.join(2, named("ben"));
  const auto bot = house.join(3, named("r2", protocol::Role::kBot));
  const auto eve = house.join(4, named("eve", protocol::Role::kSpectator));
  house.tick(3);
  CHECK(ann->welcomes.at(0).mode == "hill");
  CHECK(ann->welcomes.at(0).map_name == "table");

  house.say(1, protocol::Skip{});
  house.say(1, protocol::Skip{});  // one voice each
  house.say(3, protocol::Skip{});
  CHECK(code_of(bot->answers.back()) == "no_vote");
  CHECK(has(eve->lines,
            R"("kind":"skip","id":)" + std::to_string(ann->welcomes.at(0).id) + R"(,"name":"ann")"));
  CHECK(has(eve->lines, R"("votes":1,"needed":2)"));
  house.tick(3);
  CHECK(turns.asked == 0);
  house.say(2, protocol::Skip{});
  house.tick(2);
  REQUIRE(turns.asked == 1);
  const std::size_t before = ann->frames.size();
  house.tick(6);
  CHECK(ann->frames.size() == before + 2);  // the game goes on until the next one is there
  turns.make();
  house.tick();

  CHECK(seen.calls == std::vector<std::string>{"begin 1", "begin 2", "finish 1"});
  CHECK(house.room->census().map == "volcano");
  CHECK(house.room->census().players == 2);
  CHECK(house.room->census().bots == 3);
  for (const auto& guest : {ann, ben, bot, eve}) {
    REQUIRE(guest->welcomes.size() == 2);
    const protocol::Welcome& welcome = guest->welcomes[1];
    CHECK(welcome.mode == "roam");
    CHECK(welcome.rules.empty());
    CHECK(welcome.map_name == "volcano");
    CHECK(welcome.tick == 0);
    CHECK_FALSE(welcome.resumed);
    CHECK(welcome.players.size() == 5);
    CHECK(welcome.spectators == 1);
    CHECK(welcome.name == guest->welcomes[0].name);
    CHECK(welcome.fields == guest->welcomes[0].fields);
    CHECK((welcome.id == 0) == (guest == eve));
    // What comes behind the welcome is of the new game: a key first.
    REQUIRE(guest->frames.size() > guest->frames_at_welcome[1]);
    CHECK(guest->frames[guest->frames_at_welcome[1]].kind == FrameKind::kKey);
    for (std::size_t k = guest->frames_at_welcome[1]; k < guest->frames.size(); ++k)
      CHECK(guest->frames[k].tick < 10);
    CHECK_FALSE(has(guest->lines, "late words"));
    CHECK(std::none_of(guest->answers.begin(), guest->answers.end(),
                       [](const protocol::ServerMessage& message) {
                         return std::holds_alternative<protocol::Notice>(message);
                       }));
  }
  // Nobody hears "joined" of it, and the count of events goes on.
  CHECK_FALSE(has(ben->lines, R"("n":1,"tick":0)"));
  house.say(1, protocol::Chat{"new ground"});
  CHECK(has(ben->lines, "new ground"));
  // Votes are of a game.
  house.say(2, protocol::Skip{});
  house.tick(3);
  CHECK(turns.asked == 1);
}

TEST_CASE("a player's own count of inputs goes on in the next game, where he has a louse at rest") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  house.push(1, 40);
  house.tick(2);
  REQUIRE(last_ack(*ann));
  CHECK(last_ack(*ann)->seq == 40);
  house.say(1, protocol::Skip{});
  house.next_game();
  REQUIRE(ann->welcomes.size() == 2);
  const auto later = house.join(9, named("late"));
  house.tick(3);
  house.push(1, 40);
  CHECK(code_of(ann->answers.back()) == "stale_seq");
  house.push(1, 41);
  house.tick(2);
  CHECK(last_ack(*ann)->seq == 41);
  REQUIRE(last_ack(*ann)->you);
  CHECK(last_ack(*ann)->you->louse.id == ann->welcomes[1].id);
  CHECK(later->welcomes.at(0).map_name == "volcano");
}

TEST_CASE("a game is over after its rounds, and one without rules after as much time") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns, 2);
  const auto ann = house.join(1, named("ann"));
  house.say(1, protocol::Skip{});
  house.next_game();
  REQUIRE(ann->welcomes.at(1).mode == "roam");
  house.tick(2 * 5 * 60 * 60 - 10);
  CHECK(turns.asked == 1);
  house.tick(20);
  REQUIRE(turns.asked == 2);
  turns.make();
  house.tick();
  REQUIRE(ann->welcomes.size() == 3);
  REQUIRE(ann->welcomes[2].mode == "hill");
  // The two bots end a round of a hill at the latest when its time is over.
  int ticks = 0;
  for (; turns.asked == 2 && ticks < 4 * 1000 * 60; ticks += 60) house.tick(60);
  CHECK(turns.asked == 3);
  CHECK(has(ann->lines, R"("round":2)"));
  CHECK(has(ann->lines, R"("phase":"podium")"));
}

TEST_CASE("whose connection is broken when games change comes back to the louse that waits for him there") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  protocol::Join wanted = named("ben");
  wanted.may_resume = true;
  const auto ben = house.join(2, wanted);
  house.tick(120);
  house.door->leave(2, Parting::kLost);
  house.tick(60);
  house.say(1, protocol::Skip{});  // of those who are here it is the most
  house.next_game();
  REQUIRE(ann->welcomes.size() == 2);
  CHECK(ann->welcomes[1].players.size() == 4);
  wanted.resume = ben->welcomes.at(0).resume_token;
  house.tick(60);
  const auto back = house.join(3, wanted);
  REQUIRE(back->welcomes.size() == 1);
  CHECK(back->welcomes[0].resumed);
  CHECK(back->welcomes[0].map_name == "volcano");
  CHECK(back->welcomes[0].resume_token == wanted.resume);
  // He waits no longer than he would have.
  house.door->leave(3, Parting::kLost);
  house.tick(29 * 60);
  const auto census = house.room->census();
  CHECK(census.players == 2);
  house.tick(2 * 60);
  CHECK(house.room->census().players == 1);
}

TEST_CASE("who has asked to leave is let go when games change, and who leaves counts no more") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann")), ben = house.join(2, named("ben"));
  const auto dan = house.join(3, named("dan"));
  house.tick(3);
  protocol::Input ahead;
  ahead.seq = 1;
  ahead.thrust.value = {1.0, 0.0};
  ahead.tick = 60;
  house.say(3, ahead);
  house.say(3, protocol::Leave{});
  house.tick();
  CHECK(dan->times_let_go == 0);
  house.say(1, protocol::Skip{});
  house.say(2, protocol::Skip{});
  house.next_game();
  CHECK(dan->times_let_go == 1);
  house.door->leave(3, Parting::kLeft);
  house.settle();
  house.say(1, protocol::Skip{});
  house.door->leave(1, Parting::kLeft);  // his vote goes with him
  house.tick(3);
  CHECK(turns.asked == 1);
  house.say(2, protocol::Skip{});
  house.tick(2);
  CHECK(turns.asked == 2);
}

TEST_CASE("a room stops when the watchers of all its games are done, and what stands outside stays") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  house.say(1, protocol::Skip{});
  house.next_game();
  bool has_stopped = false;
  house.room->stop({"shutdown", "over", false}, "over", [&] { has_stopped = true; });
  house.settle();
  REQUIRE(ann->byes.size() == 1);
  CHECK(seen.calls == std::vector<std::string>{"begin 1", "begin 2", "finish 1", "finish 2"});
  const auto finish = [&] {
    const auto done = seen.unfinished.front();
    seen.unfinished.erase(seen.unfinished.begin());
    done();
    house.settle();
  };
  REQUIRE(seen.unfinished.size() == 2);
  finish();
  CHECK_FALSE(has_stopped);
  finish();
  CHECK(has_stopped);
}

TEST_CASE("who connects often has one vote with all of them") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  house.address_of = [](SessionId session) { return session < 6 ? 1 : session; };
  for (SessionId session = 1; session <= 7; ++session) house.join(session);
  for (SessionId session = 1; session <= 5; ++session) house.say(session, protocol::Skip{});
  house.tick(3);
  CHECK(turns.asked == 0);
  const auto late = house.join(8);
  house.say(2, protocol::Skip{});
  CHECK_FALSE(has(late->lines, R"("kind":"skip")"));  // he has voted
  house.say(6, protocol::Skip{});
  CHECK(has(late->lines, R"("votes":2,"needed":3)"));
  house.tick(3);
  CHECK(turns.asked == 0);
  house.say(8, protocol::Skip{});
  house.tick(2);
  CHECK(turns.asked == 1);
}

TEST_CASE("who comes back while his old connection is open votes anew, from where he is") {
  Seen seen;
  Turns turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann")), dan = house.join(2, named("dan"));
  protocol::Join wanted = named("ben");
  wanted.may_resume = true;
  const auto ben = house.join(3, wanted);
  house.say(3, protocol::Skip{});
  wanted.resume = ben->welcomes.at(0).resume_token;
  const auto back = house.join(4, wanted);
  REQUIRE(back->welcomes.at(0).resumed);
  house.tick(2);
  house.say(1, protocol::Skip{});
  CHECK(has(dan->lines, R"("votes":1,"needed":2)"));
  house.door->leave(3, Parting::kLost);
  house.tick(2);
  CHECK(turns.asked == 0);
  house.say(4, protocol::Skip{});
  house.tick(2);
  CHECK(turns.asked == 1);
  CHECK(ann->welcomes.size() == 1);
}

TEST_CASE("a room of one game alone has nothing to vote about") {
  House house(settings(8));
  house.room->start([] {});
  const auto ann = house.join(1, named("ann"));
  house.door->submit(1, protocol::Skip{}, house.timekeeper.now());
  house.settle();
  CHECK(code_of(ann->answers.back()) == "no_vote");
}

}  // namespace woodlouse::server::test
