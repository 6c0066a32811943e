// A session and all that stands around it in a test: a connection in memory, a clock, two rooms.
#pragma once

#include <spdlog/sinks/ostream_sink.h>
#include <boost/asio/io_context.hpp>
#include <catch2/catch.hpp>

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/net/session.h"
#include "shared/protocol/codec.h"
#include "tests/server/net/memory_wire.h"
#include "tests/server/timing/manual_timekeeper.h"

namespace woodlouse::server {

inline constexpr std::string_view kJoin = R"({"type":"join","protocol":1,"role":"player","name":"ann"})"
                                          "\n";

/// A room that only writes down what it is asked.
class FakeDoor final : public Door {
 public:
  explicit FakeDoor(std::string name) : name_(std::move(name)) {}

  void join(Arrival arrival) override {
    member = std::move(arrival.subscriber);
    joins.push_back(std::move(arrival.join));
  }
  void vacate(SessionId session) override { vacated.push_back(session); }
  void submit(SessionId, protocol::ClientMessage message, Time arrived) override {
    if (std::holds_alternative<protocol::Leave>(message) && member) member->let_go();
    messages.emplace_back(std::move(message), arrived);
  }
  void leave(SessionId session, Parting how) override {
    member.reset();
    left.push_back(session);
    parting = how;
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] protocol::RoomEntry census() const override {
    return {name_, name_, static_cast<std::uint32_t>(joins.size() - left.size()), 0, 0};
  }

  std::shared_ptr<Subscriber> member;
  std::vector<protocol::Join> joins;
  std::vector<std::pair<protocol::ClientMessage, Time>> messages;
  std::vector<SessionId> left, vacated;
  std::optional<Parting> parting;

 private:
  std::string name_;
};

class FakeDirectory final : public Directory {
 public:
  explicit FakeDirectory(std::vector<std::shared_ptr<FakeDoor>> doors) : doors_(std::move(doors)) {}

  [[nodiscard]] std::shared_ptr<Door> find(std::string_view name) const override {
    for (const auto& door : doors_)
      if (name.empty() || door->name() == name) return door;
    return nullptr;
  }
  [[nodiscard]] std::vector<std::string> names() const override {
    std::vector<std::string> names;
    for (const auto& door : doors_) names.push_back(door->name());
    return names;
  }
  [[nodiscard]] protocol::Rooms list() const override {
    protocol::Rooms list;
    for (const auto& door : doors_) list.rooms.push_back(door->census());
    return list;
  }
  [[nodiscard]] std::uint64_t changes() const override { return times_changed; }
  [[nodiscard]] std::string_view why_not_ready(Time) const override {
    return are_ticks_overdue ? "ticks are overdue" : "";
  }

  bool are_ticks_overdue = false;
  std::uint64_t times_changed = 0;

 private:
  std::vector<std::shared_ptr<FakeDoor>> doors_;
};

/// Runs in the test's thread. At its end the client hangs up, and nothing of the session may be left.
struct Stage {
  static constexpr SessionId kId = 0x2a;

  explicit Stage(const protocol::Limits& with = {}) : limits(with) {}
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() {
    far->hang_up(boost::asio::error::connection_reset);
    pass(std::chrono::seconds(1));  // should it wait with lines that came at once with too many
    const std::weak_ptr<Session> left = std::exchange(session, nullptr);
    CHECK(left.expired());
    CHECK(closed == 1);
    CHECK(far->is_closed);
    CHECK(far->late_calls == 0);
    CHECK(timekeeper.pending() == 0);
  }

  /// The client has come.
  void start(Session::Greeting greeting = Session::Greeting::kAtOnce) {
    session->start([this] { ++closed; }, greeting);
    run();
  }
  void start_refused(const protocol::ErrorMessage& why) {
    session->start_refused(why, [this] { ++closed; });
    run();
  }
  /// The client has come and asked to join the first room.
  void start_joined() {
    start();
    send(kJoin);
    REQUIRE(volcano->member == session);
  }
  void send(std::string_view bytes) {
    far->send(bytes);
    run();
  }
  void pass(Duration time) {
    timekeeper.advance(time);
    run();
  }
  /// Until nothing is left to do at this time.
  void run() {
    io.restart();
    io.run();
  }

  /// What the client has got so far, newlines included.
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    std::istringstream text(far->received);
    for (std::string line; std::getline(text, line);) lines.push_back(line + '\n');
    return lines;
  }
  [[nodiscard]] std::string last_line() const {
    const auto all = lines();
    return all.empty() ? std::string() : all.back();
  }
  [[nodiscard]] bool has_got(std::string_view text) const {
    return far->received.find(text) != std::string::npos;
  }

  boost::asio::io_context io{1};
  ManualTimekeeper timekeeper;
  protocol::Limits limits;
  LiveLimits live_limits{limits};
  TrafficMetrics traffic;
  std::ostringstream log;
  std::shared_ptr<FakeDoor> volcano = std::make_shared<FakeDoor>("volcano");
  std::shared_ptr<FakeDoor> meadow = std::make_shared<FakeDoor>("meadow");
  FakeDirectory directory{{volcano, meadow}};
  SessionEnvironment environment{directory,  live_limits,       traffic,
                                 timekeeper, "woodlouse a.b.c", make_log(log)};
  Lanes lanes{io, 1};
  std::shared_ptr<AddressAccount> address =
      std::make_shared<AddressAccount>(7, "10.0.0.1", limits, timekeeper.now());
  std::shared_ptr<FarEnd> far = std::make_shared<FarEnd>(lanes[0]);
  std::shared_ptr<Session> session =
      std::make_shared<Session>(kId, std::make_unique<MemoryWire>(far), lanes, 0, address, environment);
  int closed = 0;  ///< how often the session said that it is

 private:
  static std::shared_ptr<spdlog::logger> make_log(std::ostream& to) {
    auto logger =
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(to));
    logger->set_pattern("%l: %v");
    return logger;
  }
};

inline Line as_line(std::string_view text) { return Line(std::string(text)); }
inline std::string text_of(const protocol::ServerMessage& message) { return protocol::encode(message); }

}  // namespace woodlouse::server
