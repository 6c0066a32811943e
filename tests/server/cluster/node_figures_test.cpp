#include "server/cluster/node_figures.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <vector>

namespace woodlouse::server::node_figures_test {

namespace {

constexpr Time kNow{std::chrono::hours(1)};
constexpr Duration kSecond = std::chrono::seconds(1);

Writer writer_of(std::uint64_t epoch) { return {epoch, "a", {epoch, 1}}; }

/// One that has published its first batch behind number 10.
LogWriter begun(std::uint64_t epoch, Time now) {
  LogWriter writer(writer_of(epoch), 10);
  writer.add("first");
  REQUIRE(writer.next(now));
  return writer;
}

}  // namespace

TEST_CASE("batches that wait are told, and for how long as of when it is asked") {
  NodeFigures node;
  LogWriter writer = begun(1, kNow);
  node.own(writer, kNow + kSecond);
  ClusterFigures figures = node.figures({}, kNow + 3 * kSecond);
  CHECK(figures.owns);
  CHECK_FALSE(figures.ready);
  CHECK(figures.sequence == 10);
  CHECK(figures.waiting == 1);
  CHECK(figures.unacknowledged == 3 * kSecond);
  CHECK(figures.stored == 0);

  writer.acknowledged(11, kNow + 4 * kSecond);
  node.own(writer, kNow + 4 * kSecond);
  figures = node.figures({}, kNow + 9 * kSecond);
  CHECK(figures.sequence == 11);
  CHECK(figures.waiting == 0);
  CHECK(figures.unacknowledged == Duration{});
  CHECK(figures.stored == 1);
}

TEST_CASE("batches that are stored are counted over epochs, and none twice") {
  NodeFigures node;
  LogWriter first = begun(1, kNow);
  first.acknowledged(11, kNow);
  first.add("second");
  REQUIRE(first.next(kNow));
  first.acknowledged(12, kNow);
  node.own(first, kNow);
  node.own(first, kNow);
  CHECK(node.figures({}, kNow).stored == 2);
  first.read(LastBatch{11, {writer_of(1), 0, 1, {}}}, kNow);  // the stream has gone back
  node.own(first, kNow);
  CHECK(node.figures({}, kNow).stored == 2);
  LogWriter second = begun(2, kNow);
  second.acknowledged(11, kNow);
  node.own(second, kNow);
  CHECK(node.figures({}, kNow).stored == 3);
}

TEST_CASE("who follows tells whether it could go on, and nothing of it waits") {
  NodeFigures node;
  const LogWriter writer = begun(1, kNow);
  node.own(writer, kNow + kSecond);
  node.follow(true, false, 44);
  ClusterFigures figures = node.figures({}, kNow + 5 * kSecond);
  CHECK_FALSE(figures.owns);
  CHECK(figures.ready);
  CHECK(figures.sequence == 44);
  CHECK(figures.waiting == 0);
  CHECK(figures.unacknowledged == Duration{});
  node.follow(false, true, 45);
  figures = node.figures({}, kNow);
  CHECK(figures.differs);
  CHECK_FALSE(figures.ready);
}

TEST_CASE("what the log is told of is counted, and hosts by what they do") {
  NodeFigures node;
  for (const LogEvent event : {LogEvent::kClusterOwns, LogEvent::kClusterFenced, LogEvent::kClusterHole,
                               LogEvent::kClusterOwns, LogEvent::kClusterFollows, LogEvent::kClusterDurable})
    node.count(event);
  Beat owner, ready, other;
  owner.owns = true;
  ready.ready = true;
  const ClusterFigures figures = node.figures({owner, ready, ready, other, other, other}, kNow);
  CHECK(figures.takeovers == 2);
  CHECK(figures.fenced == 1);
  CHECK(figures.holes == 1);
  CHECK(figures.owners == 1);
  CHECK(figures.standing_by == 2);
  CHECK(figures.others == 3);
}

}  // namespace woodlouse::server::node_figures_test
