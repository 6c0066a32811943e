// Batches of a log, and what others say of themselves: what comes from outside is checked.
#include <catch2/catch.hpp>

#include <random>
#include <string>
#include <variant>
#include <vector>

#include "server/cluster/batch.h"
#include "server/cluster/host_table.h"
#include "shared/replay/zstd_packer.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

BatchHead some_head() {
  BatchHead head;
  head.writer = {3, "b", {0x0123456789abcdef, 0xfedcba9876543210}};
  head.number = 17;
  head.rooms = {{"volcano", 12, 40, 900}, {"hills/race", 0, 41, 12}};
  return head;
}

std::string packed(const std::string& text) {
  replay::FramePacker packer;
  std::string out;
  packer.append(out, text);
  packer.end_frame(out);
  return out;
}

std::string why_not(const std::string& text) {
  const auto batch = unpack(packed(text), "batch 5");
  REQUIRE_FALSE(batch);
  CHECK(batch.error().where.starts_with("batch 5"));
  return batch.error().text();
}

constexpr const char* kHead =
    R"({"batch":1,"epoch":2,"host":"a","nonce":"00000000000000010000000000000002","behavior":10,"rooms":[]})";

}  // namespace

TEST_CASE("a batch comes back as it was packed") {
  const BatchHead head = some_head();
  const std::string lines = "{\"room\":\"volcano\"}\n{\"step\":7}\n";
  const auto batch = unpack(pack(head, lines), "here");
  REQUIRE(batch);
  CHECK(batch->head == head);
  CHECK(batch->lines == lines);
  CHECK(unpack(pack(head, ""), "here")->lines.empty());
}

TEST_CASE("a batch that no message has room for goes in parts, and is the same once all are read") {
  std::string lines = R"({"format":)";
  std::mt19937_64 random(7);  // which no packer makes much shorter
  while (lines.size() < 3'000'000) lines += std::to_string(random());
  lines += "}\n{\"step\":7}\n";
  const BatchHead head = some_head();
  const std::vector<RoomPlace> before{{"hills/race", 2, 40, 11}};
  const auto packed = pack_in_parts(head, before, lines);
  REQUIRE(packed.size() == 4);
  WholeBatches whole;
  for (std::size_t k = 0; k < packed.size(); ++k) {
    CHECK(packed[k].size() <= kMostMessageBytes);
    const auto part = unpack(packed[k], "here");
    REQUIRE(part);
    CHECK(part->head.number == head.number + k);
    CHECK(part->head.rooms == (k == 3 ? head.rooms : before));
    const auto read = whole.take(*part);
    REQUIRE(read.has_value() == (k == 3));
    if (read) CHECK((*read == lines));
  }
  for (const std::vector<int>& order : {std::vector{0, 1, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 1, 2, 3}, {3}})
    for (const int k : order) CHECK_FALSE(whole.take(*unpack(packed[static_cast<std::size_t>(k)], "here")));
  for (const int k : {0, 1, 2}) CHECK_FALSE(whole.take(*unpack(packed[static_cast<std::size_t>(k)], "here")));
  whole.lose();
  CHECK_FALSE(whole.take(*unpack(packed[3], "here")));
  const std::string small = "{\"step\":7}\n";
  CHECK(pack_in_parts(head, before, small) == std::vector{pack(head, small)});
  std::string endless(kMostParts * kPartBytes + 1, '\n');
  for (char& c : endless) c = static_cast<char>('a' + random() % 26);
  endless.back() = '\n';
  CHECK(pack_in_parts(head, before, endless).empty());
}

TEST_CASE("lines that pack to almost nothing are in no batch that nobody may unpack") {
  std::string lines;
  while (lines.size() < 3 * kMostWholeBytes) lines += std::string(1'000'000, 'r') + "\n";
  const auto packed = pack_in_parts(some_head(), {}, lines);
  REQUIRE(packed.size() > 1);
  WholeBatches whole;
  std::optional<std::string_view> read;
  for (const std::string& message : packed) {
    CHECK(message.size() < 10'000);
    const auto part = unpack(message, "here");
    REQUIRE(part);
    read = whole.take(*part);
  }
  REQUIRE(read);
  CHECK((*read == lines));
  lines.resize(kMostWholeBytes - 1);
  CHECK(unpack(pack_in_parts(some_head(), {}, lines + "\n").front(), "here"));
}

TEST_CASE("what is no batch says where and what") {
  CHECK_FALSE(unpack("", "x"));
  CHECK_FALSE(unpack("nonsense", "x"));
  const std::string good = pack(some_head(), "{\"step\":7}\n");
  for (std::size_t size = 0; size < good.size(); ++size) CHECK_FALSE(unpack(good.substr(0, size), "x"));
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    const auto batch =
        unpack(damaged, "x");  // zstd's own sum of bytes is not asked for: what passes is checked below
    if (batch) CHECK_FALSE(batch->head.writer.host.empty());
  }
  CHECK_FALSE(why_not("{}\n").empty());
  CHECK_FALSE(why_not("[]\n").empty());
  CHECK(why_not(std::string(kHead)).find("whole") != std::string::npos);  // no newline
  std::string head(kHead);
  CHECK(unpack(packed(head + "\n"), "x"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = head;
    changed.replace(changed.find(from), from.size(), to);
    return changed + "\n";
  };
  CHECK(why_not(with("\"epoch\":2", "\"epoch\":18446744073709551615")).find("epoch") != std::string::npos);
  CHECK(why_not(with("\"epoch\":2", "\"epoch\":-2")).find("epoch") != std::string::npos);
  CHECK(why_not(with("\"host\":\"a\"", "\"host\":\"\"")).find("host") != std::string::npos);
  CHECK(why_not(with("00000000000000010000000000000002", "000000000000000100000000000000")).find("nonce") !=
        std::string::npos);
  CHECK(why_not(with("00000000000000010000000000000002", "0000000000000001000000000000000z")).find("nonce") !=
        std::string::npos);
  CHECK(why_not(with("\"rooms\":[]", "\"rooms\":7")).find("rooms") != std::string::npos);
  CHECK(why_not(with("\"rooms\":[]", "\"rooms\":[7]")).find("rooms") != std::string::npos);
  CHECK(why_not(with("\"batch\":1,", "")).find("batch") != std::string::npos);
  CHECK(why_not(with("\"batch\":1,", "\"batch\":1,\"bach\":2,")).find("bach") != std::string::npos);
}

TEST_CASE("a bomb of a batch is not unpacked") {
  CHECK_FALSE(unpack(packed(std::string(kHead) + "\n" + std::string(40u << 20, ' ') + "\n"), "x"));
}

TEST_CASE("a log's own lines come back, and a recording's pass as they are") {
  std::string text;
  append_room(text, "hills/race");
  Claim claim{7, "ann \"the\" louse", protocol::Role::kBot, {1, 2, 3, 0xffffffffffffffff}};
  append_claim(text, claim);
  append_closed(text, "hills/race");
  std::vector<BatchLine> lines;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    auto line = read_batch_line(rest.substr(0, end), "x");
    REQUIRE(line);
    lines.push_back(*line);
    rest.remove_prefix(end + 1);
  }
  REQUIRE(lines.size() == 3);
  CHECK(std::get<RoomLine>(lines[0]).room == "hills/race");
  CHECK(std::get<Claim>(lines[1]) == claim);
  CHECK(std::get<ClosedLine>(lines[2]).room == "hills/race");
  CHECK(std::get<RecordedLine>(*read_batch_line(R"({"step":3})", "x")).text == R"({"step":3})");
  CHECK_FALSE(read_batch_line(R"({"room":""})", "x"));
  CHECK_FALSE(read_batch_line(R"({"claim":1,"name":"a","role":"spectator","token":"00"})", "x"));
}

TEST_CASE("a beat comes back as it was told, and what is none is refused") {
  Beat beat;
  beat.host = "b";
  beat.address = "127.0.0.1:7777";
  beat.shard = "main";
  beat.owns = true;
  beat.writer = {9, "b", {5, 6}};
  beat.sequence = 1234;
  beat.ready = true;
  beat.process = 77;
  beat.rooms = {{"volcano", "volcano", 3, 4, 5}};
  const auto read = beat_from(to_text(beat));
  REQUIRE(read);
  CHECK(*read == beat);
  CHECK_FALSE(beat_from(""));
  CHECK_FALSE(beat_from("{}"));
  CHECK_FALSE(beat_from("[1]"));
  std::string wrong = to_text(beat);
  wrong.replace(wrong.find("true"), 4, "\"on\"");
  CHECK_FALSE(beat_from(wrong));
  CHECK_FALSE(beat_from(to_text(beat) + std::string(512 * kMostRoomsOfShard + 4096, ' ')));
}

TEST_CASE("an order to move is read as it was written, and another is not") {
  const auto read = move_order_from(to_text(MoveOrder{"a", ""}));
  REQUIRE(read);
  CHECK(read->from == "a");
  CHECK(read->to.empty());
  for (const char* wrong :
       {"", "{}", "[]", R"({"from":"a"})", R"({"from":1,"to":"b"})", R"({"from":"","to":"","x":1})"})
    CHECK_FALSE(move_order_from(wrong));
  CHECK_FALSE(move_order_from(to_text(MoveOrder{std::string(300, 'a'), ""})));
  CHECK_FALSE(move_order_from(std::string(20000, ' ')));
}

TEST_CASE("hosts that could go on try one after the other, and none while one of them hears the owner") {
  const Duration silence = std::chrono::milliseconds(250);
  const Time begin = Time{} + std::chrono::hours(1);
  HostTable table("c", "main", 1);
  const auto follower = [](const std::string& host, std::uint64_t silent_ms) {
    Beat beat;
    beat.host = host;
    beat.address = host + ":1";
    beat.shard = "main";
    beat.silent_ms = silent_ms;
    beat.ready = true;
    beat.process = 2;
    return beat;
  };
  CHECK(table.place_in_line(silence, begin) == 0u);
  table.take(follower("d", 400), begin);
  CHECK(table.place_in_line(silence, begin) == 0u);
  table.take(follower("d", 10), begin);
  CHECK_FALSE(table.place_in_line(silence, begin));  // it hears him
  table.take(follower("d", 400), begin);
  table.take(follower("b", 400), begin);
  CHECK(table.place_in_line(silence, begin) == 1u);
  Beat unable = follower("a", 0);
  unable.ready = false;
  table.take(unable, begin);
  CHECK(table.place_in_line(silence, begin) == 1u);  // who can't go on stands in nobody's way
  REQUIRE(table.successor(begin));
  CHECK(table.successor(begin)->address == "b:1");
  CHECK_FALSE(table.successor(begin + std::chrono::milliseconds(600)));
  CHECK(table.successor(begin, "d")->host == "d");
  CHECK_FALSE(table.successor(begin, "a"));  // it could not go on
  CHECK_FALSE(table.successor(begin, "nobody"));
  CHECK(table.place_in_line(silence, begin + std::chrono::milliseconds(300)) ==
        0u);  // they are silent as well
  Beat other = follower("e", 0);
  other.shard = "another";
  table.take(other, begin);
  CHECK(table.hosts(begin).size() == 3);
  CHECK_FALSE(table.has_twin(begin));
  table.take(follower("c", 0), begin);
  CHECK(table.has_twin(begin));
  CHECK(table.hosts(begin).size() == 3);
  CHECK(table.addresses(begin) == std::vector<std::string>{"a:1", "b:1", "d:1"});
  Beat own = follower("c", 0);
  own.process = 1;
  for (int k = 1; k <= 6; ++k) table.take(own, begin + std::chrono::seconds(k));
  CHECK(table.addresses(begin + std::chrono::seconds(6)).empty());
}

TEST_CASE("the owner is the one of the newest epoch who is heard and does not go") {
  const Time now = Time{} + std::chrono::hours(1);
  HostTable table("c", "main", 1);
  const auto owner = [](const std::string& host, std::uint64_t epoch) {
    Beat beat;
    beat.host = host;
    beat.address = host + ":1";
    beat.shard = "main";
    beat.owns = true;
    beat.writer = {epoch, host, {epoch, 1}};
    return beat;
  };
  CHECK_FALSE(table.owner(now));
  table.take(owner("a", 4), now);
  table.take(owner("b", 5), now);
  CHECK(table.owner(now)->host == "b");
  CHECK(table.heard({5, "b", {5, 1}}) == now);
  CHECK(table.heard({5, "b", {6, 1}}) == Time{});
  Beat leaves = owner("b", 5);
  leaves.leaves = true;
  table.take(leaves, now);
  CHECK(table.owner(now)->host == "a");
  CHECK(table.leaves(leaves.writer) == "");
  leaves.to = "c";
  table.take(*beat_from(to_text(leaves)), now);
  CHECK(table.leaves(leaves.writer) == "c");
  CHECK_FALSE(table.leaves({4, "a", {4, 1}}));
  CHECK_FALSE(table.owner(now + std::chrono::seconds(2)));
  CHECK(table.highest_epoch() == 5);
}
