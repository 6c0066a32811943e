// Who may write a log, whatever becomes of messages and answers.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "server/cluster/log_writer.h"
#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

constexpr Duration kMoment = std::chrono::milliseconds(1);

Writer writer_of(const std::string& host, std::uint64_t epoch, std::uint64_t nonce) {
  return {epoch, host, {nonce, ~nonce}};
}

/// What NATS does with a publish that expects a last sequence number. Its first message is nobody's.
struct Stream {
  struct Stored {
    BatchHead head;
    std::string bytes;
  };
  std::vector<Stored> stored{{BatchHead{writer_of("init", 0, 0), 0, match::kBehavior, {}}, "first"}};

  [[nodiscard]] std::uint64_t last_sequence() const { return stored.size(); }
  [[nodiscard]] LastBatch last(std::size_t sequences_ago = 0) const {
    const std::size_t at = stored.size() - std::min(stored.size(), sequences_ago + 1);
    return {at + 1, stored[at].head};
  }
  bool append(const Writer& writer, const std::string& bytes, std::uint64_t after) {
    if (after != last_sequence()) return false;
    stored.push_back({{writer, std::stoull(bytes), match::kBehavior, {}}, bytes});
    return true;
  }
};

/// A writer whose batches are their own numbers.
struct Host {
  LogWriter log;
  Time now{};

  Host(const Writer& writer, const Stream& stream) : log(writer, stream.last_sequence()) { add(); }
  void add() { log.add(std::to_string(log.next_number())); }
  /// Sends what is due; acknowledgements come where they are not lost.
  void send(Stream& stream, bool is_answered = true) {
    while (const auto publish = log.next(now)) {
      const bool is_stored = stream.append(log.writer(), *publish->bytes, publish->after);
      if (!is_answered) continue;
      is_stored ? log.acknowledged(publish->after + 1, now) : log.failed();
    }
  }
  void wait(Duration time) { now += time; }
  void ask(const std::optional<LastBatch>& last) {
    REQUIRE(log.is_to_ask(now));
    log.read(last, now);
  }
};

/// The stream's batches as "host:number".
std::vector<std::string> names(const Stream& stream) {
  std::vector<std::string> all;
  for (const auto& one : stream.stored) all.push_back(one.head.writer.host + ":" + one.bytes);
  return all;
}

}  // namespace

TEST_CASE("a log is taken by its first batch, and written one batch at a time") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.add();
  const auto first = a.log.next(a.now);
  REQUIRE(first);
  CHECK(first->after == 1);
  CHECK_FALSE(a.log.next(a.now));
  CHECK(a.log.state() == LogWriter::State::kTaking);
  a.log.acknowledged(2, a.now);
  CHECK(a.log.state() == LogWriter::State::kWriting);
  for (int k = 0; k < 40; ++k) a.add();
  CHECK(a.log.next(a.now)->after == 2);
  CHECK_FALSE(a.log.next(a.now));
  a.log.acknowledged(3, a.now);
  CHECK(a.log.next(a.now)->after == 3);
  CHECK(a.log.acked() == 2);
  CHECK(a.log.waiting() == 42 - 2);
  CHECK(a.log.next_sequence() == 2 + 42);
}

TEST_CASE("what was stored and never acknowledged does not go again") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  for (int k = 0; k < 3; ++k) a.add();
  a.send(stream, false);
  CHECK_FALSE(a.log.is_to_ask(a.now));
  a.wait(LogWriter::kAnswerWithin);
  a.ask(stream.last());
  CHECK(a.log.waiting() == 2);
  a.add();
  a.send(stream);
  CHECK(names(stream) == std::vector<std::string>{"init:first", "a:0", "a:1", "a:2", "a:3", "a:4"});
}

TEST_CASE("of what never arrived all goes again, as it was cut, once") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  for (int k = 0; k < 3; ++k) a.add();
  REQUIRE(a.log.next(a.now));
  a.log.failed();
  CHECK_FALSE(a.log.next(a.now));
  a.ask(std::nullopt);  // nobody answered
  CHECK_FALSE(a.log.is_to_ask(a.now));
  a.wait(LogWriter::kAskEvery);
  a.ask(stream.last());
  a.send(stream);
  CHECK(names(stream) == std::vector<std::string>{"init:first", "a:0", "a:1", "a:2", "a:3"});
}

TEST_CASE(
    "another's epoch that comes between a read and what follows it fences, and nothing is stored behind it") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  a.add();
  a.log.failed();
  const LastBatch seen = stream.last();
  Host b(writer_of("b", 2, 8), stream);
  b.send(stream);
  a.ask(seen);  // ours, still
  a.send(stream);
  CHECK(a.log.is_open());
  a.wait(LogWriter::kAskEvery);
  a.ask(stream.last());
  CHECK(a.log.state() == LogWriter::State::kFenced);
  CHECK(a.log.other() == b.log.writer());
  CHECK_FALSE(a.log.next(a.now));
  CHECK(names(stream) == std::vector<std::string>{"init:first", "a:0", "b:0"});
}

TEST_CASE("who lost his acknowledgement does not take another's epoch of the same number for his own") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  Host b(writer_of("b", 1, 8), stream);
  Host same(writer_of("a", 1, 9), stream);  // the same host's, started anew
  b.send(stream);
  for (Host* late : {&a, &same}) {
    late->send(stream);
    late->wait(LogWriter::kAskEvery);
    late->ask(stream.last());
    CHECK(late->log.state() == LogWriter::State::kLost);
    CHECK(late->log.other() == b.log.writer());
  }
}

TEST_CASE(
    "a stream that went back is told again what is kept, and an old read of a whole one is not believed") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  for (int k = 0; k < 8; ++k) a.add();
  a.send(stream);
  CHECK(a.log.waiting() == 0);
  const bool went_back = GENERATE(true, false);
  const LastBatch old = stream.last(3);
  if (went_back) stream.stored.resize(stream.stored.size() - 3);
  a.add();
  a.send(stream);  // refused, if it went back
  if (!went_back) a.log.failed();
  a.ask(old);
  CHECK(a.log.is_open());
  a.send(stream);
  if (!went_back) {
    a.wait(LogWriter::kAskEvery);
    a.ask(stream.last());
    a.send(stream);
  }
  CHECK(names(stream) == std::vector<std::string>{"init:first", "a:0", "a:1", "a:2", "a:3", "a:4", "a:5",
                                                  "a:6", "a:7", "a:8", "a:9"});
}

TEST_CASE("another's batch at the number where one's own was to be lets none of one's own in behind it") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  a.add();
  a.add();
  const auto late = a.log.next(a.now);
  REQUIRE(late);
  CHECK_FALSE(a.log.next(a.now));  // or it would be stored behind b's
  Host b(writer_of("b", 2, 8), stream);
  b.send(stream);
  CHECK_FALSE(stream.append(a.log.writer(), *late->bytes, late->after));
  a.log.failed();
  a.ask(stream.last());
  CHECK(a.log.state() == LogWriter::State::kFenced);
}

TEST_CASE("an old writer's batch that comes long after owns nothing, but the line of one's own has ended") {
  Stream stream;
  Host b(writer_of("b", 2, 8), stream);
  b.send(stream);
  stream.append(writer_of("a", 1, 7), "4", stream.last_sequence());
  b.add();
  b.send(stream);
  b.ask(stream.last());
  CHECK(b.log.state() == LogWriter::State::kGone);
}

TEST_CASE("of stored batches no more is kept than fits, and of others all") {
  constexpr std::size_t kBytes = LogWriter::kMostBytes / 4;
  LogWriter log(writer_of("a", 1, 7), 1);
  std::uint64_t stored = 1;
  for (int k = 0; k < 6; ++k) {
    log.add(std::string(kBytes, 'b'));
    REQUIRE(log.next(Time{}));
    log.acknowledged(++stored, Time{});
  }
  CHECK(log.bytes() == LogWriter::kMostBytes);
  for (int k = 0; k < 5; ++k) log.add(std::string(kBytes, 'c'));
  CHECK(log.bytes() == LogWriter::kMostBytes + 5 * kBytes);  // until one is acknowledged
  REQUIRE(log.next(Time{}));
  log.acknowledged(++stored, Time{});
  CHECK(log.waiting() == 4);
  CHECK(log.bytes() == 4 * kBytes);
}

TEST_CASE("a batch that is kept takes no more memory than it has bytes") {
  LogWriter log(writer_of("a", 1, 7), 1);
  std::string packed(1000, 'b');
  packed.reserve(100'000);
  log.add(std::move(packed));
  CHECK(log.next(Time{})->bytes->capacity() < 1100);
}

TEST_CASE("where more is missing than is kept, and where the epoch itself is, only another epoch can go on") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  for (std::size_t k = 0; k < LogWriter::kMostKept + 50; ++k) {
    a.add();
    a.send(stream);
  }
  SECTION("more") { stream.stored.resize(20); }
  SECTION("all") { stream.stored.resize(1); }
  a.add();
  for (int k = 0; k < LogWriter::kBelievedAfter + 1 && a.log.is_open(); ++k) {
    a.send(stream);
    a.wait(LogWriter::kAskEvery);
    a.ask(stream.last());
  }
  CHECK(a.log.state() == LogWriter::State::kGone);
  Host next(writer_of("a", 2, 8), stream);
  next.send(stream);
  CHECK(next.log.state() == LogWriter::State::kWriting);
}

TEST_CASE("how long nothing was acknowledged is counted from the first that waits") {
  Stream stream;
  Host a(writer_of("a", 1, 7), stream);
  a.send(stream);
  a.wait(std::chrono::seconds(60));  // idle
  CHECK(a.log.silence(a.now) == Duration{});
  a.add();
  a.send(stream, false);
  a.wait(std::chrono::seconds(2));
  a.log.failed();
  a.ask(std::nullopt);
  CHECK(a.log.silence(a.now) == std::chrono::seconds(2));
  a.wait(std::chrono::seconds(9));
  a.ask(stream.last());
  CHECK(a.log.silence(a.now) == Duration{});
}

// Writers of several hosts, publishes that come late or twice removed, answers that are lost, reads that are
// old: the log is one line of epochs, each without a gap, and nothing that was acknowledged is missing.
TEST_CASE("by whatever chance, a log is never written by two") {
  std::size_t fenced = 0, written = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    core::Random random(seed);
    const auto one_in = [&random](std::uint64_t many) { return random.next() % many == 0; };
    Stream stream;
    std::vector<Host> hosts;
    struct OnItsWay {
      std::size_t host;
      LogWriter::Publish publish;
    };
    std::deque<OnItsWay> network;
    std::vector<std::pair<Writer, std::uint64_t>> acknowledged;
    for (int step = 0; step < 120; ++step) {
      if (hosts.size() < 4 && one_in(20))
        hosts.emplace_back(writer_of(std::string(1, static_cast<char>('a' + hosts.size() % 2)),
                                     stream.last().head.writer.epoch + 1, seed * 8 + hosts.size()),
                           stream);
      if (hosts.empty()) continue;
      const std::size_t which = random.next() % hosts.size();
      Host& host = hosts[which];
      host.wait(kMoment * static_cast<int>(random.next() % 200));
      if (host.log.is_open() && one_in(3)) host.add();
      if (const auto publish = host.log.next(host.now)) network.push_back({which, *publish});
      if (host.log.is_to_ask(host.now))
        host.log.read(
            one_in(4) ? std::nullopt : std::optional(stream.last(one_in(3) ? random.next() % 3 : 0)),
            host.now);
      while (!network.empty() && !one_in(3)) {
        const OnItsWay message = network.front();
        network.pop_front();
        if (one_in(8)) continue;  // it never arrives
        Host& from = hosts[message.host];
        const bool is_stored =
            stream.append(from.log.writer(), *message.publish.bytes, message.publish.after);
        if (one_in(4)) continue;  // nobody says so
        if (is_stored) {
          from.log.acknowledged(message.publish.after + 1, from.now);
          acknowledged.emplace_back(from.log.writer(), message.publish.after + 1);
        } else {
          from.log.failed();
        }
      }
    }
    for (std::size_t k = 1; k < stream.stored.size(); ++k) {
      const BatchHead& before = stream.stored[k - 1].head;
      const BatchHead& head = stream.stored[k].head;
      if (head.writer == before.writer)
        REQUIRE(head.number == before.number + 1);
      else
        REQUIRE(head.number == 0);
    }
    for (const auto& [writer, sequence] : acknowledged)
      REQUIRE(stream.stored[sequence - 1].head.writer == writer);
    for (const Host& host : hosts) {
      fenced += host.log.state() == LogWriter::State::kFenced ? 1 : 0;
      REQUIRE(host.log.state() != LogWriter::State::kGone);
      const bool is_last = stream.last().head.writer == host.log.writer();
      if (is_last) REQUIRE(host.log.is_open());
    }
    written += stream.stored.size();
  }
  CHECK(fenced > 300);
  CHECK(written > 30'000);
}
