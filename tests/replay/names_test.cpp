// Who joined under which name and role: the same live, recorded and re-run, and found where it was altered.
#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "shared/core/joined.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

void append_utf8(std::string& out, char32_t code) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xc0 | (code >> 6));
    tail(0);
  } else if (code < 0x10000) {
    out += static_cast<char>(0xe0 | (code >> 12));
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xf0 | (code >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

/// Every character up to U+FFFF and the last ones of all, in as long names as a recording holds.
std::vector<std::string> names_of_all_characters() {
  std::vector<std::string> names{""};
  const auto add = [&](char32_t code) {
    if (code >= 0xd800 && code < 0xe000) return;
    std::string character;
    append_utf8(character, code);
    if (names.back().size() + character.size() > 4096) names.emplace_back();
    names.back() += character;
  };
  for (char32_t code = 0; code < 0x10000; ++code) add(code);
  for (char32_t code = 0x10f000; code < 0x110000; ++code) add(code);
  names.emplace_back(4096, '\0');
  names.emplace_back();
  return names;
}

/// Three come at once, one begins again with another, one goes.
std::string small_game() {
  match::Match match(small_map("spline"), {60, 3});
  ReplayWriter writer;
  std::string text;
  writer.append_header(text, make_header(match, "tests", "small.json"));
  writer.append_keyframe(text, match.state());
  while (match.tick() < 40) {
    if (match.tick() == 3) {
      match.join({"ada", state::Role::kPlayer});
      match.join({"bob", state::Role::kBot});
      match.join({"cyd", state::Role::kPlayer});
    }
    if (match.tick() == 9) {
      match.respawn(1);
      match.respawn(2);
    }
    if (match.tick() == 25) match.leave(3);
    writer.append_step(text, match.advance());
    if (match.tick() % 20 == 0) writer.append_keyframe(text, match.state());
  }
  writer.append_end(text, "done");
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to, bool everywhere) {
  std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  do {
    text.replace(at, from.size(), to);
    at = text.find(from, at + to.size());
  } while (everywhere && at != std::string::npos);
  return text;
}

/// The same by one job and by four.
Verification verdict_by_any(const std::string& text) {
  const auto verification = verify(ReplaySource::of_bytes(text, "r.jsonl"), 4);
  if (!verification) FAIL(verification.error().text());
  CHECK(to_text(*verification) == to_text(verdict(text)));
  return *verification;
}

/// Of a keyframe with so many players, each named.
std::string refusal_of_players(std::size_t count) {
  match::MatchState state;
  state.next_player = 10'000;
  for (match::PlayerId player = 1; player <= count; ++player) {
    state.players.push_back({player, {}});
    state.labels[player] = {"a", state::Role::kBot};
  }
  std::istringstream in(state_text(state));
  ReplayReader reader(in, "r");
  const auto line = reader.next();
  return line ? "no error" : line.error().text();
}

}  // namespace

TEST_CASE("a keyframe has as many players as lice at the most: each of their names is kept") {
  CHECK(refusal_of_players(kMaxLice) == "no error");
  CHECK(refusal_of_players(kMaxLice + 1).find("players[4096]: more than 4096 players") != std::string::npos);
}

TEST_CASE("a name of any characters is the same live, recorded and re-run") {
  const std::vector<std::string> names = names_of_all_characters();
  for (const Encoding encoding : {Encoding::kPlain, Encoding::kZstd}) {
    match::Match match(small_map("spline"), {60, 3});
    ReplayWriter writer(encoding);
    std::string bytes;
    writer.append_header(bytes, make_header(match, "tests", "small.json"));
    writer.append_keyframe(bytes, match.state());
    for (const std::string& name : names) {
      match.join({name, state::Role::kBot});
      writer.append_step(bytes, match.advance());
      if (match.tick() % 20 == 0) writer.append_keyframe(bytes, match.state());
    }
    writer.append_end(bytes, "done");
    CHECK(to_text(verdict_by_any(bytes)) ==
          core::joined({"ok ticks 0 to ", std::to_string(names.size()), "\n"}));
    const auto archive = opened(bytes);
    CHECK(archive->play(names.size()).value()->match().labels() == match.labels());
    REQUIRE(archive->players().size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k) REQUIRE(archive->players()[k].label.name == names[k]);
  }
}

TEST_CASE("another name or role in a join is found at its step, and whose it is is told") {
  const std::string text = small_game();
  REQUIRE(verdict_by_any(text).ok());
  const std::string join = R"({"join":2,"name":"bob","role":"bot"})";
  for (const std::string to :
       {R"({"join":2,"name":"bop","role":"bot"})", R"({"join":2,"name":"","role":"bot"})",
        R"({"join":2,"name":"bob","role":"player"})", R"({"join":2,"name":"bob\u0000","role":"bot"})"}) {
    const Verification found = verdict_by_any(replaced(text, join, to, false));
    REQUIRE(found.difference);
    CHECK(found.difference->tick == 4);
    CHECK(found.difference->what.find("hash ") == 0);
    CHECK(found.difference->detail == "keyframe 20: the name or role of player 2 is another");
  }
  // As whoever alters all that names him, the index too.
  for (const auto& [from, to] : {std::pair("\"bob\",\"bot\"", "\"bop\",\"bot\""),
                                 std::pair("\"bob\",\"role\":\"bot\"", "\"bop\",\"role\":\"bot\"")}) {
    const std::string once = replaced(text, from, to, true);
    REQUIRE(verdict_by_any(once).difference);
  }
  const Verification found = verdict_by_any(replaced(text, "\"bob\"", "\"bop\"", true));
  REQUIRE(found.difference);
  CHECK(found.difference->tick == 4);
}

TEST_CASE("another name or role in a keyframe alone is found there") {
  const std::string text = small_game();
  for (const std::string to : {R"([2,null,"bop","bot"])", R"([2,null,"bob","player"])"}) {
    const Verification found = verdict_by_any(replaced(text, R"([2,null,"bob","bot"])", to, false));
    REQUIRE(found.difference);
    CHECK(found.difference->tick == 20);
    CHECK(found.difference->what == "the keyframe is another, though every hash up to it is the same");
    CHECK(found.difference->detail == "keyframe 20: the name or role of player 2 is another");
  }
}

TEST_CASE("who began again first is found when it is told otherwise") {
  const Verification found = verdict_by_any(
      replaced(small_game(), R"({"respawn":1},{"respawn":2})", R"({"respawn":2},{"respawn":1})", false));
  REQUIRE(found.difference);
  CHECK(found.difference->tick == 10);
}

}  // namespace woodlouse::replay
