#include "bench/scenario/session.h"

#include "tests/scenarios/written_scenario.h"

using namespace woodlouse;
using namespace woodlouse::scenario;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// A scenario whose hashes are filled in.
struct Golden : WrittenScenario {
  Golden() { REQUIRE(update(file()).exit == Exit::kSame); }
  /// The file's hash of tick 20.
  [[nodiscard]] std::string hash() const {
    const std::string text = read("small.json");
    return text.substr(text.find("\"20\": \"") + 7, 16);
  }
};

std::string flipped(std::string hash) {
  hash.back() = hash.back() == '0' ? '1' : '0';
  return hash;
}

}  // namespace

TEST_CASE(
    "update fills in hashes and behavior, leaves all else as it was, and changes nothing the second time") {
  const WrittenScenario written;
  CHECK(run({}, written.file()).exit == Exit::kDiffers);
  REQUIRE(update(written.file()).exit == Exit::kSame);
  const std::string text = written.read("small.json");
  const std::string_view before =
      kSmall.substr(kSmall.find("\"map\""), kSmall.find("\"hashes\"") - kSmall.find("\"map\""));
  CHECK_THAT(text, Contains(std::string(before)));
  CHECK_THAT(text, Contains("\"behavior\": " + std::to_string(match::kBehavior) + ","));
  const Said said = run({}, written.file());
  CHECK(said.exit == Exit::kSame);
  CHECK_THAT(said.out, StartsWith("ok 1 scenarios, 2 hashes, scalar"));
  CHECK_THAT(update(written.file()).log, !Contains("updated"));  // it may name lanes this machine has none of
  CHECK(written.read("small.json") == text);
}

TEST_CASE("update begins a register beside scenarios of one's own, which then holds them to their behavior") {
  const Golden golden;
  CHECK_THAT(golden.read("goldens.txt"), Contains(std::to_string(match::kBehavior) + " small "));
  REQUIRE(run({}, golden.file()).exit == Exit::kSame);
  // Another hash of the same script and behavior is a fault, not an update.
  const std::string text = golden.read("goldens.txt");
  golden.write("goldens.txt",
               text.substr(0, text.size() - 17) + flipped(text.substr(text.size() - 17, 16)) + "\n");
  CHECK(run({}, golden.file()).exit == Exit::kDiffers);
  CHECK(update(golden.file()).exit != Exit::kSame);
}

TEST_CASE("update writes through no link that stands beside the files") {
  const WrittenScenario written;
  written.write("other", "untouched");
  for (const char* name : {"small.json.new", "goldens.txt.new"})
    std::filesystem::create_symlink("other", written.folder() / name);
  CHECK(update(written.folder()).exit == Exit::kSame);
  CHECK(written.read("other") == "untouched");
  CHECK(written.read("small.json").find("\"10\": \"") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(written.folder() / "small.json.new"));
}

TEST_CASE("a wrong hash is told with its scenario, tick, line and both hashes") {
  const Golden golden;
  const std::string hash = golden.hash();
  golden.write("small.json", with(golden.read("small.json"), hash, flipped(hash)));
  const Said said = run({}, golden.file());
  CHECK(said.exit == Exit::kDiffers);
  CHECK(said.out.empty());
  CHECK_THAT(said.log, Contains("small.json:16: hashes.20: scenario small, tick 20: hash " + flipped(hash) +
                                " expected, " + hash + " played"));
}

TEST_CASE("an altered input changes the hashes") {
  const Golden golden;
  golden.write("small.json", with(golden.read("small.json"), "[0.5, 0]", "[0.5, 0.0078125]"));
  CHECK(run({}, golden.file()).exit == Exit::kDiffers);
}

TEST_CASE("hashes of another behavior are refused with a word on what to do") {
  const Golden golden;
  const std::string mine = std::to_string(match::kBehavior);
  golden.write("small.json", with(golden.read("small.json"), "\"behavior\": " + mine, "\"behavior\": 999"));
  const Said said = run({}, golden.file());
  CHECK(said.exit == Exit::kDiffers);
  CHECK_THAT(said.log,
             Contains("999 made these hashes, this program is of behavior " + mine) && Contains("--update"));
}

TEST_CASE("the table has a line for each tick, by scenario and tick") {
  const Golden golden;
  golden.write("another.json", golden.read("small.json"));
  REQUIRE(update(golden.folder()).exit == Exit::kSame);  // registers it
  Options options;
  options.output = Output::kTable;
  const Said said = run(options, golden.folder());
  const std::string text = golden.read("small.json");
  const std::string hash10 = text.substr(text.find("\"10\": \"") + 7, 16);
  CHECK(said.exit == Exit::kSame);
  CHECK(said.out == "another 10 " + hash10 + "\nanother 20 " + golden.hash() + "\nsmall 10 " + hash10 +
                        "\nsmall 20 " + golden.hash() + "\n");
}

TEST_CASE("rooms and threads change no hash") {
  const Golden golden;
  Options options;
  options.rooms = 9;
  options.threads = 4;
  CHECK(run(options, golden.file()).exit == Exit::kSame);
  options.step_threads = 3;
  CHECK(run(options, golden.file()).exit == Exit::kSame);
}

TEST_CASE("a missing file, an empty folder and a bad file are unusable, and every bad file is named") {
  const WrittenScenario written("{");
  written.write("other.json", "[]");
  CHECK(run({}, written.folder() / "none.json").exit == Exit::kUnusable);
  const Said said = run({}, written.folder());
  CHECK(said.exit == Exit::kUnusable);
  CHECK_THAT(said.log, Contains("small.json:1: ") && Contains("other.json:1: "));
  std::filesystem::create_directory(written.folder() / "empty");
  CHECK_THAT(run({}, written.folder() / "empty").log, Contains("holds no scenario"));
}
