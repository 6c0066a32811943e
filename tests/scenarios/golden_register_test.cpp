#include "bench/scenario/golden_register.h"

#include "bench/scenario/scenario_reader.h"
#include "shared/core/stable_hash.h"
#include "tests/scenarios/written_scenario.h"

using namespace woodlouse;
using namespace woodlouse::scenario;
using Catch::Matchers::Contains;

namespace {

/// A scenario with a register as they were before the bits changed: the hash of tick 20 is another one.
struct Outdated : WrittenScenario {
  /// behavior: of the file and the register.
  explicit Outdated(int behavior) {
    REQUIRE(update(file()).exit == Exit::kSame);
    Scenario scenario = *read_scenario(file(), {}).scenario;
    std::vector<std::uint64_t> hashes{*scenario.goldens[0].hash, *scenario.goldens[1].hash ^ 1u};
    const std::string mine = "\"behavior\": " + std::to_string(match::kBehavior);
    write("small.json", with(with(scenario.text, core::to_hex(hashes[1] ^ 1u), core::to_hex(hashes[1])), mine,
                             "\"behavior\": " + std::to_string(behavior)));
    GoldenRegister golden_register;
    golden_register.set("small", {behavior, script_digest(scenario), golden_digest(hashes)});
    golden_register.set("gone", {behavior, 1, 2});
    write(kRegisterName, golden_register.text());
  }
};

}  // namespace

TEST_CASE("golden hashes change only together with the behavior") {
  const Outdated same(match::kBehavior);
  CHECK(run({}, same.file()).exit == Exit::kDiffers);
  const std::string before = same.read("small.json");
  const Said refused = update(same.file());
  CHECK(refused.exit == Exit::kDiffers);
  CHECK_THAT(refused.log, Contains("golden hashes change only together with the behavior") &&
                              Contains("raise match::kBehavior in shared/match/match.h"));
  CHECK(same.read("small.json") == before);

  const Outdated raised(match::kBehavior - 1);
  CHECK(update(raised.file()).exit == Exit::kSame);
  CHECK(run({}, raised.file()).exit == Exit::kSame);
}

TEST_CASE("hashes written by hand over those registered are found, though they are what is played") {
  const Outdated outdated(match::kBehavior);
  const std::string goldens = outdated.read(kRegisterName);
  outdated.write(kRegisterName, "");
  REQUIRE(update(outdated.file()).exit == Exit::kSame);
  REQUIRE(run({}, outdated.file()).exit == Exit::kSame);
  outdated.write(kRegisterName, goldens);
  const Said said = run({}, outdated.file());
  CHECK(said.exit == Exit::kDiffers);
  CHECK_THAT(said.log, Contains("small.json:14: hashes: are not those registered for behavior"));
}

TEST_CASE("a script that was altered, and one that is new, want to be registered") {
  const WrittenScenario written;
  written.write(kRegisterName, "");
  REQUIRE(update(written.file()).exit == Exit::kSame);
  CHECK(run({}, written.file()).exit == Exit::kSame);
  written.write("small.json", with(written.read("small.json"), "[0.5, 0]", "[0.25, 0]"));
  REQUIRE(update(written.file()).exit == Exit::kSame);
  CHECK(run({}, written.file()).exit == Exit::kSame);
  written.write(kRegisterName, "");
  CHECK_THAT(run({}, written.file()).log, Contains("is not in goldens.txt (woodlouse-scenario run --update"));
}

TEST_CASE("the register forgets scenarios that are gone, and a line that is none is told") {
  const Outdated outdated(match::kBehavior - 1);
  CHECK_THAT(outdated.read(kRegisterName), Contains(" gone "));
  REQUIRE(update(outdated.file()).exit == Exit::kSame);
  CHECK_THAT(outdated.read(kRegisterName), !Contains(" gone ") && Contains(" small "));
  outdated.write(kRegisterName, "# one\n\n2 small zz 1\n");
  const Said said = run({}, outdated.file());
  CHECK(said.exit == Exit::kUnusable);
  CHECK_THAT(said.log, Contains("goldens.txt:3: is no line of a register"));
}
