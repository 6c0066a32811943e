#include "server/room/broadcaster.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

class Listener final : public Subscriber {
 public:
  [[nodiscard]] std::size_t lane() const override { return 0; }
  void deliver(Line line) override {
    std::istringstream lines(*line);
    for (std::string one; std::getline(lines, one);) heard.push_back(one);
    ++deliveries;
  }
  void show(const Frame& frame) override { heard.push_back(frame.text->substr(0, frame.text->size() - 1)); }
  void answer(protocol::ServerMessage) override {}
  void show_again(const Frame&) override {}
  void deliver_map(Line) override {}
  void refuse_join(protocol::ErrorMessage) override {}
  void welcome(protocol::Welcome, std::uint32_t) override {}
  void let_go() override { heard.push_back("let go"); }
  void end(protocol::Bye) override {}

  std::vector<std::string> heard;
  int deliveries = 0;
};

using Heard = std::vector<std::string>;

Line line(const std::string& text) { return Line(text + "\n"); }

ChannelFrames frames(FrameKind kind, std::uint64_t tick, const std::string& text) {
  return {{1, {kind, tick, 0, tick, line("1:" + text)}}, {2, {kind, tick, 0, tick, line("2:" + text)}}};
}

struct House {
  boost::asio::io_context io{1};
  std::shared_ptr<Broadcaster> broadcaster = std::make_shared<Broadcaster>(boost::asio::make_strand(io));
  std::vector<std::shared_ptr<Listener>> listeners;

  void add(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      listeners.push_back(std::make_shared<Listener>());
      broadcaster->add({listeners.size(), listeners.back(), static_cast<ChannelId>(1 + i % 2), 0});
    }
  }
};

}  // namespace

TEST_CASE("every member hears every event in order, and the frame of its own layout") {
  House house;
  house.add(3 * Broadcaster::kSlice + 5);
  house.broadcaster->event(1, line("one"));
  house.broadcaster->event(2, line("two"));
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 60, "key"));
  house.io.run();
  for (std::size_t i = 0; i < house.listeners.size(); ++i)
    REQUIRE(house.listeners[i]->heard == Heard{"one", "two", i % 2 ? "2:key" : "1:key"});
  CHECK(house.broadcaster->backlog() == 0);
}

TEST_CASE("of frames that wait only the newest goes out, an unsent key before the delta on it") {
  House house;
  house.add(2);
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 0, "key0"));
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 60, "key60"));
  house.broadcaster->frames(FrameKind::kDelta, frames(FrameKind::kDelta, 63, "delta63"));
  house.broadcaster->frames(FrameKind::kDelta, frames(FrameKind::kDelta, 66, "delta66"));
  house.io.run();
  CHECK(house.listeners[0]->heard == Heard{"1:key60", "1:delta66"});
}

TEST_CASE(
    "events that wait go to a member together, as much as a batch holds, and frames take turns with them") {
  House house;
  house.add(2 * Broadcaster::kSlice);
  const auto late = std::make_shared<Listener>();
  house.broadcaster->add({1000, late, 1, 3});
  const std::string long_text(Broadcaster::kBatchBytes / 2, 'x');
  for (std::uint64_t n = 1; n <= 4; ++n) house.broadcaster->event(n, line(std::to_string(n) + long_text));
  for (std::uint64_t n = 5; n <= 400; ++n) house.broadcaster->event(n, line(std::to_string(n)));
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 0, "key"));
  house.broadcaster->frames(FrameKind::kDelta, frames(FrameKind::kDelta, 3, "delta"));
  house.io.run();
  const Listener& first = *house.listeners.front();
  REQUIRE(first.heard.size() == 402);
  // One event alone, as two are longer than a batch; a key after the first batch, a delta after the second.
  CHECK(first.heard[1] == "1:key");
  CHECK(first.heard[3] == "1:delta");
  CHECK(first.deliveries == 4);
  CHECK(first.heard.back() == "400");
  CHECK(late->heard.size() == 400);
  CHECK(late->heard.front() == "1:key");
  CHECK(late->heard[1] == "1:delta");
  CHECK(late->heard[2].front() == '3');
  CHECK(house.broadcaster->backlog() == 0);
}

TEST_CASE("a big broadcast lets others run between its slices") {
  House house;
  house.add(4 * Broadcaster::kSlice);
  house.broadcaster->event(1, line("one"));
  std::vector<std::size_t> served_when_run;
  std::function<void()> other = [&] {
    std::size_t served = 0;
    for (const auto& listener : house.listeners) served += listener->heard.size();
    served_when_run.push_back(served);
    if (served < house.listeners.size()) boost::asio::post(house.io, other);
  };
  boost::asio::post(house.io, other);
  house.io.run();
  CHECK(std::find_if(served_when_run.begin(), served_when_run.end(), [&](std::size_t n) {
          return n > 0 && n < house.listeners.size();
        }) != served_when_run.end());
}

TEST_CASE("who was removed hears nothing more, also in the middle of a broadcast") {
  House house;
  house.add(2 * Broadcaster::kSlice);
  house.broadcaster->event(1, line("one"));
  house.broadcaster->remove(1);
  house.broadcaster->remove(house.listeners.size());
  house.broadcaster->event(2, line("two"));
  house.io.run();
  CHECK(house.listeners[1]->heard == Heard{"one", "two"});
  CHECK(house.listeners.front()->heard.size() <= 1);
  CHECK(house.listeners.back()->heard.empty());
}

TEST_CASE("a newcomer does not hear events from before it joined") {
  House house;
  house.broadcaster->event(1, line("one"));
  const auto late = std::make_shared<Listener>();
  house.broadcaster->add({9, late, 1, 2});
  house.broadcaster->event(2, line("two"));
  house.io.run();
  CHECK(late->heard == Heard{"two"});
}

TEST_CASE("the backlog counts the events not yet handed out") {
  House house;
  house.add(1);
  for (std::uint64_t n = 1; n <= 10; ++n) house.broadcaster->event(n, line("e"));
  CHECK(house.broadcaster->backlog() == 10);
  house.io.run();
  CHECK(house.broadcaster->backlog() == 0);
}

TEST_CASE("who is let go hears every event from before it, and it alone hears that it is") {
  House house;
  house.add(2 * Broadcaster::kSlice);
  house.broadcaster->event(1, line("one"));
  house.broadcaster->let_go(2);
  house.broadcaster->event(2, line("two"));
  house.io.run();
  CHECK(house.listeners[1]->heard == Heard{"one", "let go", "two"});
  CHECK(house.listeners[2]->heard == Heard{"one", "two"});
  CHECK(house.broadcaster->backlog() == 0);
}

TEST_CASE(
    "a game that is over shows nobody a frame after that, neither of those that wait nor of one on its way") {
  House house;
  house.add(6 * Broadcaster::kSlice);
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 60, "old"));
  // Half of them have it.
  while (house.listeners[Broadcaster::kSlice]->heard.empty()) REQUIRE(house.io.poll_one() == 1);
  house.broadcaster->frames(FrameKind::kDelta, frames(FrameKind::kDelta, 63, "older"));
  house.broadcaster->event(1, line("bell"));
  house.broadcaster->drop_frames();
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 0, "new"));
  std::size_t before = 0;
  boost::asio::post(house.io, [&] {
    for (const auto& listener : house.listeners) before += listener->heard.size();
  });
  house.io.run();
  CHECK(before < 2 * house.listeners.size());
  std::ptrdiff_t shown_old = 0;
  for (const auto& listener : house.listeners) {
    REQUIRE(listener->heard.back().substr(2) == "new");
    shown_old += std::count(listener->heard.begin(), listener->heard.end(), "1:old");
    shown_old += std::count(listener->heard.begin(), listener->heard.end(), "2:old");
    CHECK(std::count(listener->heard.begin(), listener->heard.end(), "bell") == 1);
    CHECK(std::count(listener->heard.begin(), listener->heard.end(), "1:older") == 0);
  }
  CHECK(shown_old < static_cast<std::ptrdiff_t>(house.listeners.size()));
  CHECK(shown_old > 0);
}

TEST_CASE(
    "parts of the stream go to who watches by inputs alone, all that wait together, in turns with frames") {
  House house;
  house.add(2);
  const auto watcher = std::make_shared<Listener>();
  house.broadcaster->add({77, watcher, kByInputs, 0});
  const auto part = [](std::uint64_t step) {
    return StreamPart{StreamPart::Kind::kSteps, step, step + 1, line("step" + std::to_string(step))};
  };
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 0, "key"));
  for (std::uint64_t step = 0; step < 3; ++step) house.broadcaster->part(part(step));
  house.broadcaster->event(1, line("one"));
  house.io.run();
  CHECK(watcher->heard == Heard{"one", "step0", "step1", "step2"});
  CHECK(house.listeners[0]->heard == Heard{"one", "1:key"});

  house.io.restart();
  house.broadcaster->change(77, 1);
  house.broadcaster->change(1, kByInputs);
  house.broadcaster->frames(FrameKind::kKey, frames(FrameKind::kKey, 60, "key60"));
  house.broadcaster->part(part(3));
  house.io.run();
  CHECK(watcher->heard.back() == "1:key60");
  CHECK(house.listeners[0]->heard.back() == "step3");

  house.io.restart();
  for (std::uint64_t step = 4; step < 5 + Broadcaster::kMostParts; ++step)
    house.broadcaster->part(part(step));
  house.broadcaster->drop_frames();  // of a game that is over
  house.io.run();
  CHECK(house.listeners[0]->heard.back() == "step3");
}
