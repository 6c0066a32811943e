#include "bench/swarm/line_cutter.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

using woodlouse::swarm::LineCutter;

namespace {

struct Lines {
  LineCutter cutter{10};
  std::vector<std::string> lines{};
  std::size_t wanted = 100;

  bool read(std::string_view bytes) {
    return cutter.cut(bytes, [this](std::string_view line) {
      lines.emplace_back(line);
      return lines.size() < wanted;
    });
  }
};

}  // namespace

TEST_CASE("lines come out the same however the bytes are cut") {
  const std::string bytes = "one\n\ntwo 2\nthree\nfo";
  for (std::size_t first = 0; first <= bytes.size(); ++first)
    for (std::size_t second = first; second <= bytes.size(); ++second) {
      Lines lines;
      CHECK(lines.read(std::string_view(bytes).substr(0, first)));
      CHECK(lines.read(std::string_view(bytes).substr(first, second - first)));
      CHECK(lines.read(std::string_view(bytes).substr(second)));
      CHECK(lines.lines == std::vector<std::string>{"one", "", "two 2", "three"});
      CHECK(lines.read("ur\n"));
      CHECK(lines.lines.back() == "four");
    }
}

TEST_CASE("a line of the limit is taken and a longer one ends it") {
  Lines lines;
  CHECK(lines.read("0123456789\n"));
  CHECK_FALSE(lines.read("01234567890\n"));
  CHECK(lines.lines == std::vector<std::string>{"0123456789"});
  lines.cutter.reset();
  CHECK(lines.read("012345"));
  CHECK_FALSE(lines.read("67890"));
}

TEST_CASE("who wants no more lines gets none of what was read with the last") {
  Lines lines;
  lines.wanted = 2;
  CHECK_FALSE(lines.read("a\nb\nc\n"));
  CHECK(lines.lines == std::vector<std::string>{"a", "b"});
  lines.cutter.reset();
  lines.wanted = 100;
  CHECK(lines.read("d\n"));
  CHECK(lines.lines.back() == "d");
}
