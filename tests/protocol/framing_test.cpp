#include "shared/protocol/framing.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

using woodlouse::protocol::LineFramer;

namespace {

struct Cut {
  std::string text;
  bool oversize;
  friend bool operator==(const Cut&, const Cut&) = default;
};

void drain(LineFramer& framer, std::vector<Cut>& cuts) {
  while (const auto line = framer.next()) cuts.push_back({std::string(line->text), line->oversize});
}

const std::string kStream =
    "one\ntwo\r\n\nx\ry\n" + std::string(8, 'f') + "\r\n" + std::string(9, 'g') + "\nafter\n";
const std::vector<Cut> kLines = {{"one", false},      {"two", false}, {"", false},     {"x\ry", false},
                                 {"ffffffff", false}, {"", true},     {"after", false}};

}  // namespace

TEST_CASE("a stream gives the same lines wherever it is cut in two") {
  for (std::size_t at = 0; at <= kStream.size(); ++at) {
    LineFramer framer(8);
    std::vector<Cut> cuts;
    framer.append(std::string_view(kStream).substr(0, at));
    drain(framer, cuts);
    framer.append(std::string_view(kStream).substr(at));
    drain(framer, cuts);
    INFO("cut at byte " << at);
    CHECK(cuts == kLines);
  }
}

TEST_CASE("a stream gives the same lines in chunks of any size, drained at once or late") {
  for (std::size_t chunk = 1; chunk <= kStream.size(); ++chunk) {
    LineFramer eager(8);
    LineFramer late(8);
    std::vector<Cut> eager_cuts;
    std::vector<Cut> late_cuts;
    for (std::size_t at = 0; at < kStream.size(); at += chunk) {
      eager.append(std::string_view(kStream).substr(at, chunk));
      late.append(std::string_view(kStream).substr(at, chunk));
      drain(eager, eager_cuts);
    }
    drain(late, late_cuts);
    CHECK(eager_cuts == kLines);
    CHECK(late_cuts == kLines);
  }
}

TEST_CASE("a line without an end is reported once, as soon as it is too long, and takes no room") {
  LineFramer framer(16);
  framer.append(std::string(16, 'a'));
  CHECK_FALSE(framer.next());
  framer.append("bb");
  const auto line = framer.next();
  REQUIRE(line);
  CHECK(line->oversize);
  for (int i = 0; i < 1000; ++i) {
    framer.append(std::string(1000, 'c'));
    CHECK_FALSE(framer.next());
  }
  framer.append("c\nok\n");
  const auto next = framer.next();
  REQUIRE(next);
  CHECK(next->text == "ok");
}

TEST_CASE("a line of exactly the limit passes, with and without a carriage return") {
  for (const std::string end : {"\n", "\r\n"}) {
    LineFramer framer(4);
    framer.append("1234");
    CHECK_FALSE(framer.next());
    framer.append(end);
    const auto line = framer.next();
    REQUIRE(line);
    CHECK_FALSE(line->oversize);
    CHECK(line->text == "1234");
    CHECK_FALSE(framer.next());
  }
}
