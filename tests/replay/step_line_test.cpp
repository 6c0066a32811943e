// The scanner of steps against the document's parser: what one gives, the other gives; what is unusual is
// left to it.
#include "shared/replay/step_line.h"

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/line_writer.h"

using namespace woodlouse;
using namespace woodlouse::replay;

namespace {

/// What the document's parser gives for a line that scan_step() knows: a tab, which it does not, goes before.
std::optional<StepLine> read_by_document(const std::string& line) {
  REQUIRE_FALSE(scan_step("\t" + line));
  std::istringstream in("\t" + line + "\n");
  ReplayReader reader(in, "r");
  const auto read = reader.next_line();
  if (!read || !*read || !std::holds_alternative<StepLine>(**read)) return std::nullopt;
  return std::get<StepLine>(**read);
}

bool same(const StepLine& a, const StepLine& b) {
  return a.step.tick == b.step.tick && a.step.hash == b.step.hash && a.step.roster.empty() &&
         b.step.roster.empty() && a.step.inputs == b.step.inputs && a.margins_ms == b.margins_ms &&
         a.steps == b.steps;
}

state::Thrust some_thrust(core::Random& random) {
  const auto quanta = [&] { return static_cast<double>(random.next() % 257) - 128.0; };
  switch (random.next() % 3) {
    case 0:
      return {};
    case 1:
      return state::rounded_along_heading(quanta() / 128.0).thrust;
    default:
      return state::rounded_map_vector({quanta() / 128.0, quanta() / 128.0}).thrust;
  }
}

std::string some_line(core::Random& random) {
  match::StepRecord step;
  Margins margins;
  step.tick = random.next() >> (11 + random.next() % 50);
  step.hash = random.next();
  for (std::uint64_t k = random.next() % 4; k > 0; --k) {
    match::AppliedInput input;
    input.player = static_cast<state::LouseId>(1 + random.next() % 0xffff'fffe);
    input.seq = static_cast<std::uint32_t>(random.next());
    const state::Thrust thrust = some_thrust(random);
    input.kind = thrust.kind;
    input.thrust = thrust.value;
    input.ticks = random.next() % 2 == 0 ? state::kHeld : static_cast<std::uint32_t>(random.next() % 1000);
    input.tick = step.tick;
    step.inputs.push_back(input);
    if (random.next() % 3 != 0)
      margins[{input.player, input.seq}] = static_cast<std::int64_t>(random.next() % 2001) - 1000;
  }
  std::string line;
  append_step(line, step, margins);
  line.pop_back();  // the newline
  return line;
}

}  // namespace

TEST_CASE("a step as the writer writes it is scanned, and as the document's parser reads it") {
  core::Random random(3);
  int scanned = 0;
  for (int k = 0; k < 3000; ++k) {
    const std::string line = some_line(random);
    INFO(line);
    const auto by_document = read_by_document(line);
    REQUIRE(by_document);
    if (const auto step = scan_step(line)) {
      CHECK(same(*step, *by_document));
      ++scanned;
    }
  }
  CHECK(scanned > 2500);  // the others have a minus zero, or a tick of 16 digits
}

TEST_CASE("what the scanner gives for an altered step, the document's parser gives, too") {
  core::Random random(5);
  constexpr std::string_view kBytes = "0123456789-+.,:[]{}\"eE nulstepihak/\\\t";
  int scanned = 0;
  for (int k = 0; k < 60000; ++k) {
    std::string line = some_line(random);
    for (std::uint64_t n = 1 + random.next() % 2; n > 0; --n) {
      const std::size_t at = random.next() % line.size();
      const char byte = kBytes[random.next() % kBytes.size()];
      switch (random.next() % 3) {
        case 0:
          line[at] = byte;
          break;
        case 1:
          line.insert(at, 1, byte);
          break;
        default:
          line.erase(at, 1);
      }
    }
    const auto step = scan_step(line);
    if (!step) continue;
    INFO(line);
    const auto by_document = read_by_document(line);
    REQUIRE(by_document);
    CHECK(same(*step, *by_document));
    ++scanned;
  }
  CHECK(scanned > 5000);
}

TEST_CASE("what is unusual in a step is left to the document's parser") {
  const std::string hash = R"("hash":"0123456789abcdef"})";
  const std::vector<std::string> lines = {R"({"step":3,"roster":[{"leave":4}],)" + hash,
                                          R"({"step":3,"steps":4,)" + hash,
                                          R"({"step":3,"inputs":[],)" + hash,
                                          R"({"step":3,"inputs":[[1,2,0.5]],)" + hash,
                                          R"({"step":3,"inputs":[[1,2,129]],)" + hash,
                                          R"({"step":3,"inputs":[[1,2,[100,100]]],)" + hash,
                                          R"({"step":3,"inputs":[[1,2,-0]],)" + hash,
                                          R"({"step":3,"inputs":[[0,2,5]],)" + hash,
                                          R"({"step":3,"inputs":[[1,2,5,0,4294967295]],)" + hash,
                                          R"({"step":03,)" + hash,
                                          R"({"step":9007199254740993,)" + hash,
                                          R"({"hash":"0123456789abcdef","step":3})",
                                          R"({"step":3,"hash":"0123456789ABCDEF"})",
                                          R"({"step":3,"hash":"0123456789abcdef"}})"};
  for (const std::string& line : lines) {
    INFO(line);
    CHECK_FALSE(scan_step(line));
  }
  CHECK(scan_step(R"({"step":3,"inputs":[[1,2,[96,-80],null,7]],)" + hash));
  std::string longest = R"({"step":3,"inputs":[[1,2,3])";
  while (longest.size() < (1u << 16)) longest += ",[1,2,3]";
  CHECK_FALSE(scan_step(longest + "]," + hash));
}
