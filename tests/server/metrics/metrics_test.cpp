// What is told of a server while it runs: the list of it, its text, and that it agrees with what was counted.
#include "server/metrics/metrics.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "server/metrics/families.h"
#include "server/metrics/process.h"
#include "server/metrics/scrape.h"
#include "shared/protocol/codes.h"
#include "tests/server/room/house.h"

namespace woodlouse::server::metrics_test {
namespace {

using namespace woodlouse::server::test;

bool has(const std::string& text, std::string_view wanted) { return text.find(wanted) != std::string::npos; }

/// A server without doors; the room is not open yet.
struct Watched : House {
  explicit Watched(Watchers watchers = {}) : House(settings(8), open(), std::move(watchers)) {}

  std::optional<ClusterFigures> cluster;
  Lobby lobby;
  TrafficMetrics traffic;
  LiveLimits limits{protocol::Limits{}};
  std::optional<Recordings> recordings;
  Metrics metrics{{lobby, traffic, limits, timekeeper, recordings, [] { return std::uint64_t{7}; }, "1.2.3",
                   [this] { return cluster; }}};
};

/// Finds something out while the room stands still.
class Finder final : public TickWatcher {
 public:
  explicit Finder(const bool& found) : found_(found) {}
  void begin(const match::Match&) override {}
  void finish(const std::string&, std::function<void()> done) override { done(); }
  void add_figures(RoomFigures& figures) const override {
    figures.recording.emplace().failed = found_;
    figures.shadow.emplace().differences = found_ ? 3 : 0;
  }

 private:
  const bool& found_;
};

}  // namespace

TEST_CASE("the table of docs/metrics.md is the list of metrics in the code") {
  std::ifstream file(WOODLOUSE_SOURCE_DIR "/docs/metrics.md");
  REQUIRE(file);
  std::vector<std::string> rows;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("| `woodlouse_") || line.starts_with("| `process_")) rows.push_back(line);
  REQUIRE(rows.size() == families().size());
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const FamilyEntry& entry = families()[k];
    CHECK(rows[k] == "| `" + std::string(entry.name) + "` | " + std::string(to_text(entry.kind)) + " | " +
                         std::string(entry.labels) + " | " + std::string(entry.help) + " |");
    CHECK(names.insert(entry.name).second);
  }
}

TEST_CASE("a label holds any name and stays one line of a text that can be parsed") {
  Scrape scrape;
  scrape.add(Family::kRoomTicks, std::uint64_t{5}, "a\"b\\c\nd\xff");
  scrape.add(Family::kRoomMembers, std::uint64_t{2}, "hügel/race", "bot");
  const std::string text = scrape.text();
  CHECK(has(text, "woodlouse_room_ticks_total{room=\"a\\\"b\\\\c?d?\"} 5\n"));
  CHECK(has(text, "woodlouse_room_members{room=\"hügel/race\",role=\"bot\"} 2\n"));
  CHECK(
      has(text,
          "# HELP woodlouse_room_ticks_total Steps performed.\n# TYPE woodlouse_room_ticks_total counter\n"));
  CHECK_FALSE(has(text, "woodlouse_sessions"));  // without a series it is not there
}

TEST_CASE("a histogram's buckets add up, and a bound is in its own bucket") {
  DurationHistogram lateness;
  for (const int us : {100, 101, 99'999, 100'000, 100'001, 0}) lateness.add(std::chrono::microseconds(us));
  Scrape scrape;
  scrape.add(Family::kRoomTickLateness, lateness, "r");
  const std::string text = scrape.text(), name = "woodlouse_room_tick_lateness_seconds";
  CHECK(has(text, name + "_bucket{room=\"r\",le=\"0.0001\"} 2\n"));
  CHECK(has(text, name + "_bucket{room=\"r\",le=\"0.00025\"} 3\n"));
  CHECK(has(text, name + "_bucket{room=\"r\",le=\"0.05\"} 3\n"));
  CHECK(has(text, name + "_bucket{room=\"r\",le=\"0.1\"} 5\n"));
  CHECK(has(text, name + "_bucket{room=\"r\",le=\"+Inf\"} 6\n"));
  CHECK(has(text, name + "_count{room=\"r\"} 6\n"));
  CHECK(has(text, name + "_sum{room=\"r\"} 0.300201\n"));
}

TEST_CASE("a room has its series while it is open, and they agree with it") {
  Watched server;
  CHECK_FALSE(has(server.metrics.text(), "room="));
  REQUIRE(server.lobby.open(server.room, [] {}));
  protocol::Join join;
  join.name = "zzyzx";
  server.join(1, join);
  server.tick(121);
  const std::string text = server.metrics.text();
  CHECK(has(text, "woodlouse_room_ticks_total{room=\"volcano\"} 120\n"));  // as of its last whole second
  CHECK(has(text, "woodlouse_room_tick_lateness_seconds_count{room=\"volcano\"} 120\n"));
  CHECK(has(text, "woodlouse_room_members{room=\"volcano\",role=\"player\"} 1\n"));
  CHECK(has(text, "woodlouse_room_asleep{room=\"volcano\"} 0\n"));
  CHECK_FALSE(has(text, "zzyzx"));  // nobody's name is told
  CHECK(has(server.metrics.status(), "volcano: players 1, bots 0, spectators 0; ticks 120, "));
  REQUIRE(server.lobby.close("volcano", {"shutdown", "closed", false}, "closed", [] {}));
  CHECK_FALSE(has(server.metrics.text(), "room="));
}

TEST_CASE("names that are shown alike are told apart") {
  Watched server;
  REQUIRE(server.lobby.open(server.room, [] {}));
  for (const char* name : {"volcano?", "volcano\x01"}) {
    RoomSettings other = settings(8);
    other.name = name;
    REQUIRE(server.lobby.open(Room::make(server.ticks, server.lanes, std::move(other), House::open(), {},
                                         server.timekeeper, server.log),
                              [] {}));
  }
  const std::string text = server.metrics.text();
  CHECK(has(text, "woodlouse_room_ticks_total{room=\"volcano\"} 0\n"));
  CHECK(has(text, "woodlouse_room_ticks_total{room=\"volcano?\"} 0\n"));
  CHECK(has(text, "woodlouse_room_ticks_total{room=\"volcano?-2\"} 0\n"));
}

TEST_CASE("what is found out while a room stands still is told, and its next tick is not overdue") {
  bool found = false;
  Watchers watchers;
  watchers.push_back(std::make_unique<Finder>(found));
  Watched server(std::move(watchers));
  REQUIRE(server.lobby.open(server.room, [] {}));
  server.tick(700);
  CHECK(has(server.metrics.text(), "woodlouse_room_asleep{room=\"volcano\"} 1\n"));
  server.settle();
  CHECK(has(server.metrics.text(), "woodlouse_recording_failed{room=\"volcano\"} 0\n"));
  found = true;
  server.settle();
  CHECK(has(server.metrics.text(), "room="));  // and so asks the room
  server.settle();
  const std::string text = server.metrics.text();
  CHECK(has(text, "woodlouse_recording_failed{room=\"volcano\"} 1\n"));
  CHECK(has(text, "woodlouse_shadow_differences_total{room=\"volcano\"} 3\n"));
  CHECK(has(text, "woodlouse_room_tick_overdue_seconds{room=\"volcano\"} 0\n"));
  CHECK(server.lobby.why_not_ready(server.timekeeper.now()).empty());
}

TEST_CASE("a room that hangs in its tick is too late after half a second, and on time once it goes on") {
  Watched server;
  REQUIRE(server.lobby.open(server.room, [] {}));
  server.join(1);
  server.tick(10);
  CHECK(server.lobby.why_not_ready(server.timekeeper.now()).empty());
  server.timekeeper.advance(std::chrono::milliseconds(500));  // and nobody runs what is due
  CHECK(server.lobby.why_not_ready(server.timekeeper.now()).empty());
  server.timekeeper.advance(std::chrono::milliseconds(500));
  CHECK(server.lobby.why_not_ready(server.timekeeper.now()) == "ticks are overdue");
  CHECK(has(server.metrics.status(), "TICKS OVERDUE"));
  CHECK(has(server.metrics.text(), "woodlouse_room_tick_overdue_seconds{room=\"volcano\"} 0.98"));
  server.settle();
  CHECK(server.lobby.why_not_ready(server.timekeeper.now()).empty());
  CHECK(has(server.metrics.text(), "woodlouse_room_tick_overdue_seconds{room=\"volcano\"} 0\n"));
}

TEST_CASE("what was counted is told by its code, reason and status, each of which is there from the start") {
  Watched server;
  for (const protocol::CodeEntry& entry : protocol::codes())
    if (has(std::string(entry.messages), "error"))
      CHECK(has(server.metrics.text(),
                "woodlouse_refused_lines_total{code=\"" + std::string(entry.code) + "\"} 0\n"));
  server.traffic.refused_lines.add(protocol::code::kBadJson);
  server.traffic.session_ends.add(protocol::code::kSlow);
  server.traffic.refuse(RefusedConnection::kNoTls);
  server.traffic.answer(404);
  server.traffic.answer(200);
  const std::string text = server.metrics.text();
  CHECK(has(text, "woodlouse_refused_lines_total{code=\"bad_json\"} 1\n"));
  CHECK(has(text, "woodlouse_session_ends_total{code=\"slow\"} 1\n"));
  CHECK(has(text, "woodlouse_session_ends_total{code=\"lost\"} 0\n"));
  CHECK(has(text, "woodlouse_connections_refused_total{reason=\"no_tls\"} 1\n"));
  CHECK(has(text, "woodlouse_web_refused_total{status=\"404\"} 1\n"));
  CHECK(has(text, "woodlouse_web_requests_total 2\n"));
  CHECK(has(text, "woodlouse_log_lines_lost_total 7\n"));
  CHECK(has(text, "woodlouse_build_info{version=\"1.2.3\",behavior=\""));
}

TEST_CASE("a host of a cluster tells its part in it, and who is in none tells nothing of one") {
  Watched server;
  CHECK_FALSE(has(server.metrics.text(), "woodlouse_cluster_"));
  CHECK_FALSE(has(server.metrics.status(), "cluster"));
  ClusterFigures figures;
  figures.shard = "main";
  figures.owns = figures.connected = true;
  figures.sequence = 61;
  figures.waiting = 3;
  figures.unacknowledged = std::chrono::milliseconds(2500);
  figures.stored = 40;
  figures.takeovers = 2;
  figures.fenced = 1;
  figures.holes = 5;
  figures.standing_by = 2;
  figures.others = 4;
  server.cluster = figures;
  const std::string text = server.metrics.text();
  CHECK(has(text, "woodlouse_cluster_owns 1\n"));
  CHECK(has(text, "woodlouse_cluster_ready 0\n"));
  CHECK(has(text, "woodlouse_cluster_differs 0\n"));
  CHECK(has(text, "woodlouse_cluster_connected 1\n"));
  CHECK(has(text, "woodlouse_cluster_hosts{role=\"owns\"} 0\n"));
  CHECK(has(text, "woodlouse_cluster_hosts{role=\"stands_by\"} 2\n"));
  CHECK(has(text, "woodlouse_cluster_hosts{role=\"other\"} 4\n"));
  CHECK(has(text, "woodlouse_cluster_batch 61\n"));
  CHECK(has(text, "woodlouse_cluster_batches_waiting 3\n"));
  CHECK(has(text, "woodlouse_cluster_unacknowledged_seconds 2.5\n"));
  CHECK(has(text, "woodlouse_cluster_batches_stored_total 40\n"));
  CHECK(has(text, "woodlouse_cluster_takeovers_total 2\n"));
  CHECK(has(text, "woodlouse_cluster_fenced_total 1\n"));
  CHECK(has(text, "woodlouse_cluster_holes_total 5\n"));
  const std::string owner = "\ncluster: shard main: owns its rooms, stored up to batch 61, 3 wait";
  CHECK(has(server.metrics.status(),
            owner + "; NOTHING STORED for 2.5 s; other hosts: 0 own, 2 stand by, 4 can't"));

  server.cluster = ClusterFigures{};
  server.cluster->differs = true;
  CHECK(has(server.metrics.text(), "woodlouse_cluster_differs 1\n"));
  CHECK(has(server.metrics.status(), "CAN'T TAKE OVER"));
  CHECK(has(server.metrics.status(), "FOLLOWER DIFFERS; NATS IS NOT CONNECTED"));
  server.cluster->ready = true;
  CHECK(has(server.metrics.status(), "stands by, has read up to batch 0"));
}

TEST_CASE("how many descriptors are open is known, and when none is left, too") {
  const Process process;
  const ProcessFigures before = process.figures();
  REQUIRE(before.open_descriptors);
  REQUIRE(before.resident_bytes);
  CHECK(*before.resident_bytes > 1'000'000);
  CHECK(before.start_s > 1.6e9);
  std::vector<int> opened;
  for (int k = 0; k < 5; ++k) opened.push_back(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  CHECK(*process.figures().open_descriptors == *before.open_descriptors + opened.size());
  for (const int descriptor : opened) ::close(descriptor);
  CHECK(*process.figures().open_descriptors == *before.open_descriptors);
}

}  // namespace woodlouse::server::metrics_test
