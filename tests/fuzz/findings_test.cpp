// What fuzzing has found, and bombs that are too big for a fuzzer to make: each must get an error of one
// line, quickly.
#include <catch2/catch.hpp>
#include <ctime>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/map/esri_ascii_grid.h"
#include "shared/map/flt_grid_file.h"
#include "shared/map/map_file.h"
#include "shared/protocol/codec.h"
#include "shared/replay/archive.h"
#include "shared/replay/writer.h"
#include "tests/fuzz/property.h"

using namespace woodlouse;

namespace {

/// Of processor time; what is linear takes a tenth of it, what is quadratic minutes. The sanitizers' share is
/// in it.
constexpr double kMaxSeconds = 20.0;

std::string repeated(std::string_view part, std::size_t times) {
  std::string text;
  text.reserve(part.size() * times);
  for (std::size_t k = 0; k < times; ++k) text += part;
  return text;
}

/// 0, 1, .. each between `before` and `after`, separated by commas.
std::string numbered(std::string_view before, std::string_view after, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    text.append(k == 0 ? "" : ",").append(before).append(std::to_string(k)).append(after);
  }
  return text;
}

/// Runs what gives an error's text; checks that it is one readable line and came soon.
void check_refused(const std::function<std::string()>& error_of) {
  const std::clock_t begin = std::clock();
  const std::string text = error_of();
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  INFO(text.substr(0, 2000));
  CHECK(seconds < kMaxSeconds);
  CHECK_FALSE(text.empty());
  CHECK(text.size() <= fuzz::kMaxErrorBytes);
  CHECK(fuzz::is_plain_line(text));
}

std::string map_error(std::string_view text) {
  const auto map = map::parse_map(text, "m.json", {});
  return map ? std::string() : map.error().text();
}

std::string grid_error(std::string_view text) {
  json::Problems problems("g.asc");
  const auto grid = map::parse_esri_ascii_grid(text, problems);
  return grid ? std::string() : problems.errors().front().text();
}

std::string server_line_error(std::string_view line) {
  const auto message = protocol::decode_server(line, protocol::default_columns(), protocol::Format::kExact);
  return message ? std::string() : message.error().text;
}

std::shared_ptr<const map::Map> small_map() {
  return *map::parse_map(R"({"name":"m","terrain":{"function":"hills"},"surface":"function"})", "m.json", {});
}

/// A recording's first two lines, and whatever `more` says.
std::string recording(std::string_view more) {
  const match::Match match(small_map(), {60, 1});
  replay::ReplayWriter writer;
  std::string text;
  writer.append_header(text, replay::make_header(match, "test", "m.json"));
  writer.append_keyframe(text, match.state());
  return text.append(more);
}

std::string recording_error(std::string bytes) {
  const auto archive =
      replay::ReplayArchive::open(replay::ReplaySource::of_bytes(std::move(bytes), "r.ndjson"));
  if (!archive) return archive.error().text();
  const auto playback = (*archive)->play((*archive)->first_tick());
  if (!playback) return playback.error().text();
  for (;;) {
    const auto step = (*playback)->advance();
    if (!step) return step.error().text();
    if (!*step) return {};
  }
}

const std::string kHash = R"("hash":"0123456789abcdef"})";

}  // namespace

TEST_CASE("a key of any bytes is cited on one line") {
  CHECK(map_error("{\"a\\nb\":1}").substr(0, 13) == "m.json:1: a?b");
  for (const std::string_view key : {R"(a\nb)", R"(\u001b[2J)", R"(\u0085)", "\x7f"}) {
    const std::string text = "\"" + std::string(key) + "\":1";
    check_refused([&] { return map_error("{" + text + "}"); });
    check_refused([&] { return map_error("{" + text + "," + text + "}"); });
    check_refused(
        [&] { return map_error(R"({"name":"m","terrain":{"function":"hills"},"physics":{)" + text + "}}"); });
    check_refused([&] { return recording_error("{" + text + "}\n"); });
    check_refused([&] { return recording_error(recording("{\"step\":0," + text + "," + kHash + "\n")); });
    check_refused([&] { return server_line_error("{" + text + "," + text + "}"); });
  }
}

TEST_CASE("a word of a grid file of any bytes is cited on one line") {
  for (const std::string word : {"\x1b[2J", "\xff", "cel\xc3", "a\x01"}) {
    check_refused([&] { return grid_error("ncols 4 nrows 4 " + word + " 1\n"); });
    check_refused([&] { return grid_error("ncols " + word + "\n"); });
    check_refused([&] { return map::parse_flt_header("ncols " + word + "\n", "g.hdr").error().text(); });
    check_refused([&] { return map::parse_flt_header(word + " 4\n", "g.hdr").error().text(); });
    check_refused([&] {
      return map::parse_flt_header("ncols 4\nnrows 4\nnbits " + word + "\n", "g.hdr").error().text();
    });
  }
}

TEST_CASE("a recording that names a map of any bytes is refused on one line") {
  for (const char* name : {R"(no\nsuch.json)", R"(\u001b[2J.json)"}) {
    std::string text = recording({});
    const std::size_t begin = text.find("\"definition\":");
    text.replace(begin, text.find('\n') - 1 - begin, std::string("\"file\":\"") + name + "\"}");
    check_refused([&] { return recording_error(text); });
  }
}

TEST_CASE("a map without speed and pull reads back the same though it wrote -0") {
  const auto map = map::parse_map(
      R"({"name":"m","terrain":{"function":"hills"},"physics":{"central_gravity":-0.0},"spawns":[{"position":[0,0],"speed":-0.0}]})",
      "m.json", {});
  REQUIRE(map);
  CHECK(fuzz::same_bits((*map)->definition.physics.central_gravity, 0.0));
  CHECK(fuzz::same_bits((*map)->definition.spawns.front().speed, 0.0));
}

TEST_CASE("a row of heights is a list") {
  const std::string row = R"({"a":0,"b":0,"c":0,"d":0})";
  const std::string list = "[0,0,0,0]";
  for (const std::string& rows :
       {row + "," + list + "," + list + "," + list, list + "," + list + "," + row + "," + list}) {
    check_refused(
        [&] { return map_error(R"({"name":"m","terrain":{"spacing":1,"heights":[)" + rows + "]}}"); });
  }
}

TEST_CASE("bombs of nesting are refused at once") {
  constexpr std::size_t kDepth = 1'000'000;
  for (const std::string_view part : {"[", "{\"a\":", "[{\"a\":"}) {
    const std::string bomb = repeated(part, kDepth);
    check_refused([&] { return map_error(bomb); });
    check_refused([&] { return map_error("{\"name\":" + bomb); });
    check_refused([&] { return server_line_error(bomb); });
    check_refused([&] { return recording_error(bomb + "\n"); });
    check_refused([&] { return recording_error(recording("{\"step\":" + bomb + "\n")); });
  }
}

TEST_CASE("bombs of keys, words and digits are refused at once") {
  constexpr std::size_t kMany = 150'000;
  const std::string keys = "{" + numbered("\"terain", "\":0", kMany) + "}";
  check_refused([&] { return map_error(keys); });
  check_refused([&] { return map_error(R"({"name":"m","terrain":)" + keys + "}"); });
  check_refused([&] { return recording_error(keys + "\n"); });
  check_refused([&] { return recording_error(recording("{\"step\":0," + keys.substr(1) + "\n")); });
  check_refused([&] { return server_line_error("{\"type\":\"hello\"," + keys.substr(1)); });
  check_refused([&] { return server_line_error("{" + repeated("\"a\":0,", kMany) + "\"a\":0}"); });
  const std::string letters(2'000'000, 'a');
  const std::string digits(2'000'000, '9');
  for (const std::string& text : {"\"" + letters + "\"", digits, "0." + digits, "-" + digits + "e-2000000"}) {
    check_refused([&] { return map_error("{\"name\":" + text + "}"); });
    check_refused([&] { return map_error("{\"" + letters + "\":" + text + "}"); });
    check_refused([&] { return recording_error(recording("{\"step\":" + text + "," + kHash + "\n")); });
    check_refused([&] { return server_line_error("{\"type\":" + text + "}"); });
    check_refused([&] { return grid_error("ncols " + text); });
  }
  check_refused([&] { return grid_error(repeated("ncols 4\n", kMany)); });
  check_refused([&] { return grid_error(repeated("nclos 4\n", kMany)); });
  check_refused([&] { return grid_error("ncols 2000 nrows 2000 xllcorner 0 yllcorner 0 cellsize 1\n"); });
}

TEST_CASE("a map that is wrong in every height is refused at once") {
  const std::string row = "[" + repeated("\"x\",", 999) + "7]";
  check_refused([&] {
    return map_error(R"({"name":"m","terrain":{"spacing":1,"heights":[)" + repeated(row + ",", 999) + row +
                     "]}}");
  });
}

TEST_CASE("a recording of more lice than a server takes is refused at once") {
  constexpr std::size_t kMany = 300'000;
  const auto step = [](std::string_view roster) {
    return std::string("{\"step\":0,\"roster\":[").append(roster).append("],").append(kHash).append("\n");
  };
  const std::string joins = numbered("{\"join\":1", "}", kMany);
  const std::string leaves = numbered("{\"leave\":1", "}", kMany);
  check_refused([&] { return recording_error(recording(step(joins + "," + leaves))); });
}

TEST_CASE("a recording of one endless line is refused at once, packed too") {
  const std::string line(replay::kMaxReplayLineBytes + (1u << 20), ' ');
  check_refused([&] { return recording_error(line); });
  check_refused([&] { return recording_error(recording(line)); });
}
