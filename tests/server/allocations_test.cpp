// What the path of an input and of a delta allocates, once a room and its sessions are in their pace: bytes
// in, a line, a message, the room's queue, the step, the ack, its line, the outbox, the wire; rows, a frame,
// every session's outbox. Nobody records: a recorder hands each step to its thread in memory of its own.
//
// One thread runs all. Between threads a hop (a message to the room's strand, an answer or a frame to a
// session's) may cost its block once more: Asio keeps those of hops that have run for the thread that ran
// them.
#include <spdlog/sinks/null_sink.h>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/net/session.h"
#include "server/net/tcp_wire.h"
#include "server/room/room.h"
#include "server/timing/steady_timekeeper.h"
#include "tests/server/counted_allocations.h"
#include "tests/server/room/house.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;

/// A client that reads at once and keeps nothing but what it counts.
class QuietWire final : public Wire {
 public:
  explicit QuietWire(asio::io_context& io) : io_(io) {}

  void read_some(std::span<char> into, Handler handler) override {
    into_ = into;
    read_ = std::move(handler);
  }
  [[nodiscard]] std::size_t write_now(std::span<const Line> lines) override {
    std::size_t size = 0;
    for (const Line& line : lines) {
      size += line->size();
      acks += line->starts_with(R"({"type":"ack")") ? 1 : 0;
      deltas += line->starts_with(R"({"type":"delta")") ? 1 : 0;
    }
    return size;
  }
  void write(std::span<const Line>, std::size_t, Handler) override { FAIL("all goes at once"); }
  [[nodiscard]] boost::system::error_code shut_down_sending() override { return {}; }
  [[nodiscard]] boost::system::error_code close() override {
    if (!read_.empty()) asio::post(io_, [done = std::exchange(read_, {})] { done(asio::error::eof, 0); });
    return {};
  }

  void send(std::string_view bytes) {
    REQUIRE(bytes.size() <= into_.size());
    std::copy(bytes.begin(), bytes.end(), into_.begin());
    asio::post(io_, [done = std::exchange(read_, {}), size = bytes.size()] { done({}, size); });
  }
  void hang_up() {
    asio::post(io_, [done = std::exchange(read_, {})] { done(asio::error::connection_reset, 0); });
  }

  std::size_t acks = 0;
  std::size_t deltas = 0;

 private:
  asio::io_context& io_;
  std::span<char> into_;
  Handler read_;
};

class OneRoom final : public Directory {
 public:
  explicit OneRoom(std::shared_ptr<Door> door) : door_(std::move(door)) {}
  [[nodiscard]] std::shared_ptr<Door> find(std::string_view) const override { return door_; }
  [[nodiscard]] std::vector<std::string> names() const override { return {door_->name()}; }
  [[nodiscard]] protocol::Rooms list() const override { return {}; }
  [[nodiscard]] std::string_view why_not_ready(Time) const override { return {}; }
  [[nodiscard]] std::uint64_t changes() const override { return 0; }

 private:
  std::shared_ptr<Door> door_;
};

/// A room of 60 ticks and 20 frames a second, bots in it, and sessions: a player, who pushes every tick, and
/// who watches, in so many layouts.
class Pace {
 public:
  static constexpr std::size_t kSeconds = 5;  ///< counted

  explicit Pace(std::size_t watchers, std::size_t layouts = 1) : layouts_(layouts) {
    room_->start([] {});
    for (std::size_t k = 0; k <= watchers; ++k) {
      auto wire = std::make_unique<QuietWire>(io_);
      wires_.push_back(wire.get());
      sessions_.push_back(
          std::make_shared<Session>(k + 1, std::move(wire), lanes_, 0, address_, environment_));
      sessions_.back()->start([this] { ++closed_; });
    }
    asio::post(io_, [this] { turn(); });
    io_.run();
  }

  std::size_t allocated = 0;
  std::size_t acks = 0;
  std::size_t deltas = 0;  ///< sent to everybody together

 private:
  static constexpr std::size_t kTurns = 40;    ///< of the loop a tick: more than any message has hops
  static constexpr std::size_t kWarmUp = 630;  ///< ticks
  static constexpr std::size_t kTicks = kWarmUp + 60 * kSeconds;

  static RoomSettings settings() {
    RoomSettings result;
    result.name = "volcano";
    result.bots = 20;
    return result;
  }

  /// Everything that a tick brings happens between two of these that have turn 0.
  void turn() {
    if (turn_ == 0) begin_tick();
    if (turn_ == kTurns / 2) timekeeper_.advance(std::chrono::nanoseconds(16'666'667));
    if (++turn_ == kTurns) {
      end_tick();
      turn_ = 0;
      if (++tick_ == kTicks) return end();
    }
    asio::post(io_, [this] { turn(); });
  }

  void begin_tick() {
    if (tick_ == 0) return;
    if (tick_ == 1) return join();
    if (tick_ == kWarmUp) {
      acks -= total(&QuietWire::acks);
      deltas -= total(&QuietWire::deltas);
      test::count_allocations();
    }
    char line[128];
    const int size = std::snprintf(line, sizeof line,
                                   "{\"type\":\"input\",\"seq\":%zu,\"thrust\":[0.5,-0.%zu],\"ticks\":30}\n",
                                   tick_, tick_ % 10);
    wires_[0]->send({line, static_cast<std::size_t>(size)});
  }

  void join() {
    for (std::size_t k = 0; k < wires_.size(); ++k) {
      std::string line = R"({"type":"join","protocol":1,"name":"ann","role":")";
      line += k == 0 ? "player" : "spectator";
      line += R"(","fields":["id","x","y","vx","vy")";
      const std::string_view more[] = {R"(,"z")", R"(,"yaw")", R"(,"speed")", R"(,"phase")"};
      for (std::size_t n = 0; n < k % layouts_; ++n) line += more[n];
      wires_[k]->send(line + "]}\n");
    }
  }

  void end_tick() {
    if (tick_ + 1 != kTicks) return;
    allocated = test::allocations_counted();
    acks += total(&QuietWire::acks);
    deltas += total(&QuietWire::deltas);
  }

  [[nodiscard]] std::size_t total(std::size_t QuietWire::*count) const {
    std::size_t sum = 0;
    for (const QuietWire* wire : wires_) sum += wire->*count;
    return sum;
  }

  void end() {
    for (QuietWire* wire : wires_) wire->hang_up();
    room_->stop({"shutdown", "the test ends", false}, "test", [] {});
  }

  asio::io_context io_{1};
  Lanes lanes_{io_, 1};
  std::shared_ptr<spdlog::logger> log_ =
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>());
  ManualTimekeeper timekeeper_;
  std::shared_ptr<Room> room_ =
      Room::make(io_, lanes_, settings(), test::Contexts::open(), {}, timekeeper_, log_);
  LiveLimits limits_{{}};
  std::shared_ptr<AddressAccount> address_ =
      std::make_shared<AddressAccount>(1, "10.0.0.1", *limits_.now(), timekeeper_.now());
  TrafficMetrics traffic_;
  OneRoom directory_{room_->door()};
  SessionEnvironment environment_{directory_, limits_, traffic_, timekeeper_, "woodlouse", log_};
  std::size_t layouts_;
  std::vector<QuietWire*> wires_;
  std::vector<std::shared_ptr<Session>> sessions_;
  int closed_ = 0;
  std::size_t tick_ = 0;
  std::size_t turn_ = 0;
};

/// Once a second, the figures that other threads read are made anew.
constexpr std::size_t kFigures = Pace::kSeconds;
constexpr std::size_t kFrames = 20 * Pace::kSeconds;

TEST_CASE("a room in its pace allocates nothing for an input, its ack and a frame, however many watch") {
  const std::size_t watchers = GENERATE(0u, 1u, 60u);
  const Pace pace(watchers);
  CHECK(pace.acks == 60 * Pace::kSeconds);
  CHECK(pace.deltas == (watchers + 1) * (kFrames - Pace::kSeconds));  // the others are keys
  CHECK(pace.allocated == kFigures);
}

TEST_CASE("up to four layouts go out without memory of their own, more of them with one list a frame") {
  CHECK(Pace(10, 4).allocated == kFigures);
  CHECK(Pace(10, 5).allocated == kFigures + kFrames);
}

/// The wire and the alarm that a server has in place of the ones above: rounds of one write, one read and one
/// alarm, each begun by the end of the one before.
class TcpRounds {
 public:
  TcpRounds() {
    asio::ip::tcp::acceptor acceptor(io_, {asio::ip::address_v4::loopback(), 0});
    far_.connect(acceptor.local_endpoint());
    wire_ = std::make_unique<TcpWire>(acceptor.accept());
    asio::post(io_, [this] { write(); });
    io_.run();
  }

  std::size_t rounds = 0;
  std::size_t allocated = 0;

 private:
  void write() {
    wire_->write(lines_, 0, [this](const boost::system::error_code&, std::size_t) { read(); });
  }
  void read() {
    const std::size_t size = far_.read_some(asio::buffer(bytes_));
    far_.write_some(asio::buffer(bytes_.data(), size));
    wire_->read_some(bytes_, [this](const boost::system::error_code&, std::size_t) { wait(); });
  }
  void wait() {
    alarm_->set(timekeeper_.now(), [this](bool) { end_round(); });
  }
  void end_round() {
    ++rounds;
    if (rounds == 20) test::count_allocations();
    if (rounds < 120) return write();
    allocated = test::allocations_counted();
  }

  asio::io_context io_{1};
  asio::ip::tcp::socket far_{io_};
  std::unique_ptr<TcpWire> wire_;
  SteadyTimekeeper timekeeper_;
  std::unique_ptr<Alarm> alarm_ = timekeeper_.make_alarm(io_.get_executor());
  std::vector<Line> lines_{Line("one\n"), Line("two\n"), Line("three\n")};
  std::array<char, 100> bytes_{};
};

TEST_CASE("a wire over TCP and an alarm allocate nothing either") {
  const TcpRounds pace;
  CHECK(pace.rounds == 120);
  CHECK(pace.allocated == 0);
}

}  // namespace
}  // namespace woodlouse::server
