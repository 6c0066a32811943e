// A session and a real room: whoever leaves, by word or by ending its sending side, is answered first.
#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/net/session.h"
#include "tests/server/net/memory_wire.h"
#include "tests/server/room/house.h"

namespace woodlouse::server::leaving_test {

using std::chrono::seconds;

namespace {

constexpr std::string_view kJoin = "{\"type\":\"join\",\"protocol\":1,\"name\":\"ann\"}\n";
constexpr std::string_view kLeave = "{\"type\":\"leave\"}\n";
constexpr std::string_view kBye =
    "{\"type\":\"bye\",\"code\":\"left\",\"text\":\"goodbye\",\"resumable\":false}\n";
constexpr int kMostTicks = 2 * 60 + 1;  // as far as an input may ask ahead, and the step that takes it

class OneRoom final : public Directory {
 public:
  explicit OneRoom(std::shared_ptr<Door> door) : door_(std::move(door)) {}
  [[nodiscard]] std::shared_ptr<Door> find(std::string_view name) const override {
    return name.empty() || name == door_->name() ? door_ : nullptr;
  }
  [[nodiscard]] std::vector<std::string> names() const override { return {door_->name()}; }
  [[nodiscard]] protocol::Rooms list() const override { return {{door_->census()}}; }
  [[nodiscard]] std::string_view why_not_ready(Time) const override { return {}; }
  [[nodiscard]] std::uint64_t changes() const override { return 0; }

 private:
  std::shared_ptr<Door> door_;
};

enum class Ending { kWord, kEndOfInput, kBoth };
enum class Network { kFree, kBusy };  // busy: a write is in flight while the client speaks

struct Visit {
  Visit() {
    house.room->start([] {});
    session->start([this] { closed = true; });
    house.settle();
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;
  ~Visit() {
    far->let_go();
    far->hang_up(boost::asio::error::connection_reset);
    house.settle();
    CHECK(closed);
  }

  /// All of it in one read.
  void say_and_end(std::string said, Ending ending) {
    if (ending != Ending::kEndOfInput) said += kLeave;
    far->send(said);
    if (ending != Ending::kWord) far->hang_up();
    house.settle();
  }
  void join() {
    far->send(kJoin);
    house.settle();
    house.tick();
    far->received.clear();
  }
  [[nodiscard]] bool has_got(std::string_view text) const {
    return far->received.find(text) != std::string::npos;
  }

  test::House house{test::settings(8)};
  OneRoom directory{house.door};
  LiveLimits limits{{}};
  TrafficMetrics traffic;
  SessionEnvironment environment{directory, limits, traffic, house.timekeeper, "woodlouse a.b.c", house.log};
  std::shared_ptr<FarEnd> far = std::make_shared<FarEnd>(house.lanes[0]);
  std::shared_ptr<AddressAccount> address =
      std::make_shared<AddressAccount>(1, "10.0.0.1", *limits.now(), house.timekeeper.now());
  std::shared_ptr<Session> session =
      std::make_shared<Session>(7, std::make_unique<MemoryWire>(far), house.lanes, 0, address, environment);
  bool closed = false;
};

struct Question {
  std::string line;
  std::vector<std::string> answers;
};

const std::vector<Question> kQuestions = {
    {R"({"type":"input","seq":1,"thrust":1})",
     {R"("type":"ack","seq":1,"tick":1,)", R"("dropped":false)", "\"you\""}},
    {R"({"type":"input","seq":1,"thrust":1,"tick":90})", {R"("type":"ack","seq":1,"tick":90,)", "\"you\""}},
    {R"({"type":"input","seq":1,"thrust":1,"tick":121})", {R"("type":"ack","seq":1,"tick":121,)", "\"you\""}},
    {R"({"type":"input","seq":1,"thrust":1,"tick":999})", {"\"too_far\"", R"("type":"ack","seq":1,)"}},
    {R"({"type":"chat","text":"hello"})", {R"("kind":"chat")"}},
    {R"({"type":"list"})", {R"("type":"rooms")"}},
    {R"({"type":"get_map"})", {R"("type":"map")"}},
    {R"({"type":"resync"})", {R"("type":"key")"}},
    {R"({"type":"respawn"})", {R"("kind":"respawned")"}},
    {R"({"type":"ping","t":5})", {R"("type":"pong","t":5)"}},
    {R"({"type":"dance"})", {R"("type":"error","code":"unknown_type")"}},
    {R"({"type":"join","protocol":1,"name":"bob"})", {R"("type":"error","code":"already_joined")"}},
};

}  // namespace

TEST_CASE("who leaves or ends its sending side in the same write is answered first, then gets its bye") {
  const auto question = GENERATE(from_range(kQuestions));
  const auto ending = GENERATE(Ending::kWord, Ending::kEndOfInput, Ending::kBoth);
  const auto network = GENERATE(Network::kFree, Network::kBusy);
  INFO(question.line << ", ending " << static_cast<int>(ending) << ", network " << static_cast<int>(network));
  Visit visit;
  visit.join();
  if (network == Network::kBusy) {
    visit.far->holds_writes = true;
    visit.far->send("{\"type\":\"ping\",\"t\":1}\n");
    visit.house.settle();
    REQUIRE(visit.far->is_writing());
  }
  visit.say_and_end(question.line + '\n', ending);
  visit.house.tick(kMostTicks);
  visit.far->let_go();
  visit.house.settle();
  for (const std::string& answer : question.answers) CHECK(visit.has_got(answer));
  CHECK(visit.far->received.ends_with(kBye));
  CHECK(visit.far->is_shut);
  visit.house.timekeeper.advance(Session::kLinger);
  visit.house.settle();
  CHECK(visit.closed);
  CHECK(visit.house.room->census().players == 0);
}

TEST_CASE("who comes, asks for everything and goes in one write is answered to the end") {
  const auto ending = GENERATE(Ending::kWord, Ending::kEndOfInput, Ending::kBoth);
  Visit visit;
  std::string said(kJoin);
  std::vector<std::string> wanted{R"("type":"welcome")", R"("type":"key")", R"("kind":"joined")"};
  std::uint32_t seq = 0;
  for (Question question : kQuestions) {
    for (std::string* text : {&question.line, &question.answers[0], &question.answers.back()})
      if (const auto at = text->find("\"seq\":1"); at != std::string::npos)
        text->replace(at, 7, "\"seq\":" + std::to_string(seq + 1));
    seq += question.line.find("\"seq\"") != std::string::npos ? 1 : 0;
    said += question.line + '\n';
    wanted.insert(wanted.end(), question.answers.begin(), question.answers.end());
  }
  visit.say_and_end(said, ending);
  visit.house.tick(kMostTicks + 1);
  for (const std::string& answer : wanted) {
    INFO(answer);
    CHECK(visit.has_got(answer));
  }
  CHECK(visit.far->received.ends_with(kBye));
}

TEST_CASE("who leaves goes with the step that takes its last input, not before and not later") {
  const auto ending = GENERATE(Ending::kWord, Ending::kEndOfInput);
  Visit visit;
  visit.join();
  visit.say_and_end("{\"type\":\"input\",\"seq\":1,\"thrust\":1,\"tick\":30}\n", ending);
  visit.house.tick(29);
  CHECK(visit.house.room->census().players == 1);
  CHECK_FALSE(visit.has_got("\"ack\""));
  visit.house.tick();
  CHECK(visit.house.room->census().players == 0);
  CHECK(visit.has_got("\"ack\""));
}

TEST_CASE("after its leave a client is not heard, so that it can't stay by talking") {
  Visit visit;
  visit.join();
  visit.far->send(std::string("{\"type\":\"input\",\"seq\":1,\"thrust\":1,\"tick\":30}\n") +
                  std::string(kLeave));
  visit.house.settle();
  for (int tick = 1; tick < 30; ++tick) {
    visit.far->send("{\"type\":\"input\",\"seq\":" + std::to_string(tick + 1) + ",\"thrust\":1,\"tick\":" +
                    std::to_string(tick + 60) + "}\n{\"type\":\"ping\",\"t\":1}\n");
    visit.house.tick();
  }
  visit.house.tick();
  CHECK(visit.house.room->census().players == 0);
  CHECK_FALSE(visit.has_got("\"pong\""));
  CHECK(visit.far->received.ends_with(kBye));
}

TEST_CASE("a spectator that ends its sending side is let go at once, as it could say nothing more") {
  Visit visit;
  visit.say_and_end("{\"type\":\"join\",\"protocol\":1,\"role\":\"spectator\",\"name\":\"eve\"}\n",
                    Ending::kEndOfInput);
  CHECK(visit.has_got(R"("type":"key")"));
  CHECK(visit.far->received.ends_with(kBye));
  CHECK(visit.closed);
  CHECK(visit.house.room->census().spectators == 0);
}

TEST_CASE(
    "who ends its sending side without a join, or after one that was refused, gets its answers and a bye") {
  const auto said = GENERATE(as<std::string>{}, "", "{\"type\":\"list\"}\n",
                             "{\"type\":\"join\",\"protocol\":1,\"name\":\"ann\",\"room\":\"moon\"}\n");
  Visit visit;
  visit.say_and_end(said, Ending::kEndOfInput);
  CHECK(visit.has_got("\"rooms\":[{") == (said.find("list") != std::string::npos));
  CHECK(visit.has_got("unknown_room") == (said.find("moon") != std::string::npos));
  CHECK(visit.far->received.ends_with(kBye));
  CHECK(visit.closed);
}

TEST_CASE("a line that the end of input cuts off is none") {
  Visit visit;
  visit.say_and_end("{\"type\":\"ping\",\"t\":1}\n{\"type\":\"ping\",\"t\":2}", Ending::kEndOfInput);
  CHECK(visit.has_got(R"("t":1)"));
  CHECK_FALSE(visit.has_got(R"("t":2)"));
}

TEST_CASE("a fatal fault is told to a client that ended its sending side meanwhile") {
  Visit visit;
  visit.far->holds_writes = true;
  visit.say_and_end("rubbish\nrubbish\nrubbish\n", Ending::kEndOfInput);
  CHECK_FALSE(visit.closed);
  visit.far->let_go();
  visit.house.settle();
  CHECK(visit.has_got("\"bye\",\"code\":\"bad_json\""));
  CHECK(visit.closed);
}

TEST_CASE(
    "who reads its answers slowly has as long as any write may take, who does not read is cut off then") {
  const auto ending = GENERATE(Ending::kWord, Ending::kEndOfInput);
  const auto reads = GENERATE(true, false);
  Visit visit;
  visit.join();
  visit.far->holds_writes = true;
  visit.say_and_end("{\"type\":\"get_map\"}\n", ending);
  CHECK(visit.house.room->census().players == 0);  // it waits outside
  const auto most = seconds(visit.limits.now()->idle_s);
  visit.house.timekeeper.advance(most - Duration(1));
  visit.house.settle();
  CHECK_FALSE(visit.closed);
  if (reads) {
    visit.far->let_go();
    visit.house.settle();
    CHECK(visit.has_got(R"("type":"map")"));
    CHECK(visit.far->received.ends_with(kBye));
  }
  visit.house.timekeeper.advance(Duration(1));
  visit.house.settle();
  CHECK(visit.closed);
}

}  // namespace woodlouse::server::leaving_test
