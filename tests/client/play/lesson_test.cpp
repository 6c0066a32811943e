#include "client/play/modes/lesson.h"

#include <catch2/catch.hpp>

#include "client/play/modes/private_gate.h"

using namespace woodlouse;
using namespace woodlouse::client;

TEST_CASE("a gate of one's own times laps through it, one way alone") {
  PrivateGate gate;
  const rules::Images flat({});
  core::Time now{std::chrono::seconds(10)};
  LouseSample louse;
  gate.set(louse, {1.0, 0.0}, now);
  const auto move = [&](double x, double y, double vx) {
    now += std::chrono::milliseconds(100);
    louse.position = {x, y};
    louse.velocity = {vx, 0.0};
    return gate.observe(louse, flat, now);
  };
  CHECK_FALSE(move(0.5, 0.0, 5.0));
  CHECK_FALSE(move(0.5, 5.0, 5.0));
  CHECK_FALSE(move(-0.5, 5.0, -5.0));  // past its end
  CHECK_FALSE(move(-0.5, 0.0, 0.0));
  const auto lap = move(0.5, 0.0, 5.0);
  REQUIRE(lap);
  CHECK(*lap == Approx(0.45).margin(0.01));
  CHECK(gate.is_best());
  CHECK_FALSE(move(-0.5, 0.0, -5.0));  // back
  CHECK(plain_text(gate.line(now)).find("best 0:00.4") != std::string::npos);
}

TEST_CASE("the lesson's first push goes where the rules of play want one") {
  Lesson lesson(20.0);
  lesson.observe({});
  KeyLabels keys;
  keys.compass = true;
  const auto key_to = [&](core::Vec2 towards) {
    const std::string told = plain_text(lesson.lines(keys, towards)[0]);
    REQUIRE(told.substr(0, 15) == "1/3 PUSH  hold ");
    return told.substr(15, told.find(',') - 15);
  };
  CHECK(key_to({0.0, 1.0}) == "W");
  CHECK(key_to({-5.0, -4.0}) == "A");
  CHECK(key_to({-4.0, -5.0}) == "S");
  CHECK(key_to({5.0, 4.0}) == "D");
  CHECK(plain_text(lesson.lines(keys)[1]).find("A left  S down") != std::string::npos);
  CHECK(plain_text(lesson.lines(keys, {1.0, 0.0}, Winds::kSpoken)[1]).find("A west, S south") !=
        std::string::npos);
  keys.compass = false;  // a push goes along the heading, whichever way that is
  CHECK(key_to({-5.0, 0.0}) == "W");
}

TEST_CASE("the lesson goes on once a thing was done, and not before") {
  Lesson lesson(20.0);
  LessonFacts facts;
  const auto pass = [&](double seconds) {
    bool changed = false;
    for (int i = 0; i < static_cast<int>(seconds * 20.0); ++i) {
      facts.now += std::chrono::milliseconds(50);
      changed |= lesson.observe(facts);
    }
    return changed;
  };
  const auto head = [&] { return lesson.lines().empty() ? std::string() : lesson.lines()[0][0].text; };
  pass(5.0);
  CHECK(head() == "1/3 PUSH");
  facts.is_pushing = true;
  pass(2.0);
  CHECK(head() == "1/3 PUSH");  // it does not move
  facts.speed = 2.0;
  pass(0.1);
  CHECK(head() == "2/3 TURN");
  facts.heading = {0.0, 1.0};
  pass(0.1);
  CHECK(head() == "3/3 SWING");
  facts.slope_degrees = 20.0;
  facts.height = 5.0;
  pass(3.0);
  CHECK(head() == "3/3 SWING");  // up without a swing
  facts.slope_degrees = -20.0;
  facts.height = 1.0;
  pass(1.0);
  facts.slope_degrees = 20.0;
  facts.height = 2.5;
  pass(0.1);
  CHECK(head() == "WELL DONE");
  CHECK(lesson.is_learnt());
  pass(5.0);
  CHECK(lesson.is_over());
  Lesson flat(0.1);
  flat.observe(facts);
  CHECK(flat.lines()[0][0].text == "1/2 PUSH");
  flat.skip();
  CHECK(flat.lines().empty());
}
