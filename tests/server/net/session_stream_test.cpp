// A session that watches by inputs.
#include <catch2/catch.hpp>

#include <string>
#include <variant>

#include "tests/server/net/session_stage.h"

namespace woodlouse::server::session_stream_test {
namespace {

using Kind = StreamPart::Kind;

constexpr std::string_view kWatch =
    R"({"type":"join","protocol":1,"role":"spectator","name":"eve","stream":"inputs"})"
    "\n";

struct Watching : Stage {
  explicit Watching(const protocol::Limits& with = {}) : Stage(with) {
    start();
    send(kWatch);
    REQUIRE(volcano->member == session);
    REQUIRE(volcano->joins.back().stream == protocol::Stream::kInputs);
    protocol::Welcome welcome;
    welcome.stream = protocol::Stream::kInputs;
    session->welcome(welcome, 1);
    session->follow({Kind::kHeader, 0, 0, as_line("{\"format\"}\n")});
    session->follow({Kind::kKeyframe, 100, 100, as_line("{\"keyframe\":100}\n")});
    run();
    far->received.clear();
  }
  void step(std::uint64_t number) {
    session->follow({Kind::kSteps, number, number + 1, as_line(text(number))});
    run();
  }
  static std::string text(std::uint64_t number) {
    return "{\"step\":" + std::to_string(number) + ",\"hash\":\"0123456789abcdef\"}\n";
  }
  [[nodiscard]] std::size_t resyncs() const {
    std::size_t count = 0;
    for (const auto& [message, at] : volcano->messages)
      count += std::holds_alternative<protocol::Resync>(message);
    return count;
  }
};

protocol::Limits small() {
  protocol::Limits limits;
  limits.outbox_bytes = 2000;  // 500 of the stream
  return limits;
}

}  // namespace

TEST_CASE("a stream goes out as it comes, behind the welcome") {
  Stage stage;
  stage.start();
  stage.send(kWatch);
  protocol::Welcome welcome;
  welcome.stream = protocol::Stream::kInputs;
  stage.session->welcome(welcome, 1);
  stage.session->follow({Kind::kHeader, 0, 0, as_line("{\"format\"}\n")});
  stage.session->follow({Kind::kKeyframe, 7, 7, as_line("{\"keyframe\":7}\n")});
  stage.session->follow({Kind::kSteps, 7, 8, as_line(Watching::text(7))});
  stage.run();
  CHECK(stage.far->received.ends_with("{\"format\"}\n{\"keyframe\":7}\n" + Watching::text(7)));
  CHECK(stage.has_got(R"("stream":"inputs")"));
}

TEST_CASE(
    "who does not read is sent no broken sequence: once he reads, a keyframe is asked for, and charged") {
  Watching stage(small());
  stage.far->holds_writes = true;
  for (std::uint64_t number = 100; number < 140; ++number) stage.step(number);
  CHECK(stage.resyncs() == 0);
  stage.far->let_go();
  stage.run();
  CHECK(stage.resyncs() == 1);
  stage.step(140);  // nothing until the keyframe is here
  CHECK(stage.far->received == Watching::text(100));
  stage.session->follow({Kind::kKeyframe, 141, 141, as_line("{\"keyframe\":141}\n")});
  stage.step(141);
  CHECK(stage.far->received == Watching::text(100) + "{\"keyframe\":141}\n" + Watching::text(141));
  CHECK(stage.resyncs() == 1);
  CHECK_FALSE(stage.has_got("slow"));
  CHECK_FALSE(stage.has_got("notice"));
}

TEST_CASE("keyframes of more bytes than answers may have are asked for as late as any answer") {
  protocol::Limits limits = small();
  limits.answer_bytes_per_s = 100;
  Watching stage(limits);
  const auto fall_behind = [&stage](std::uint64_t first) {
    stage.far->holds_writes = true;
    for (std::uint64_t number = first; number < first + 40; ++number) stage.step(number);
    stage.far->let_go();
    stage.run();
  };
  const auto go_on = [&stage](std::uint64_t tick) {
    stage.session->follow({Kind::kKeyframe, tick, tick, as_line(std::string(5000, 'k') + '\n')});
    stage.run();
  };
  fall_behind(100);
  REQUIRE(stage.resyncs() == 1);
  go_on(200);
  fall_behind(200);
  const std::size_t second = stage.resyncs();
  if (second == 2) go_on(300), fall_behind(300);
  CHECK(stage.resyncs() == second);  // it waits
  stage.pass(std::chrono::seconds(120));
  CHECK(stage.resyncs() == second + 1);
}

TEST_CASE("a resync is charged what the last keyframe brought, the steps behind it too") {
  protocol::Limits limits;
  limits.answer_bytes_per_s = 100;
  Watching stage(limits);
  StreamPart keyframe{Kind::kKeyframe, 100, 100, as_line("{\"keyframe\":100}\n"), true};
  StreamPart kept{Kind::kSteps, 100, 101, as_line(std::string(5000, 's') + '\n'), true};
  stage.session->follow(keyframe);
  stage.session->follow(kept);
  stage.session->follow({Kind::kSteps, 101, 102, as_line(std::string(50'000, 's') + '\n')});  // to all
  stage.run();
  const std::string resync = "{\"type\":\"resync\"}\n";
  stage.send(resync);
  CHECK(stage.resyncs() == 1);
  stage.send(resync);
  CHECK(stage.resyncs() == 1);
  stage.pass(std::chrono::seconds(30));
  CHECK(stage.resyncs() == 1);
  stage.pass(std::chrono::seconds(30));
  CHECK(stage.resyncs() == 2);
}

TEST_CASE("a watcher who wants every second part is written to half as often, and misses none") {
  Stage stage;
  stage.start();
  stage.send(kWatch);
  protocol::Welcome welcome;
  welcome.stream = protocol::Stream::kInputs;
  stage.session->welcome(welcome, 2);
  stage.session->follow({Kind::kKeyframe, 7, 7, as_line("{\"keyframe\":7}\n")});
  stage.run();
  stage.far->received.clear();
  const std::size_t before = stage.far->writes;
  for (std::uint64_t number = 7; number < 17; ++number) {
    stage.session->follow({Kind::kSteps, number, number + 1, as_line(Watching::text(number))});
    stage.run();
  }
  CHECK(stage.far->writes - before == 5);
  CHECK(stage.far->received.find("\"step\":15") != std::string::npos);
}

TEST_CASE("a next game's welcome drops what is left of the game before") {
  Watching stage;
  stage.far->holds_writes = true;
  for (std::uint64_t number = 100; number < 103; ++number) stage.step(number);
  stage.session->welcome({}, 1);
  stage.session->follow({Kind::kHeader, 0, 0, as_line("{\"format\":2}\n")});
  stage.session->follow({Kind::kKeyframe, 1, 1, as_line("{\"keyframe\":1}\n")});
  stage.run();
  stage.far->let_go();
  stage.run();
  CHECK_FALSE(stage.has_got("\"step\":101"));
  CHECK(stage.far->received.ends_with("{\"format\":2}\n{\"keyframe\":1}\n"));
}

}  // namespace woodlouse::server::session_stream_test
