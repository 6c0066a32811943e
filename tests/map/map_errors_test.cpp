#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_file.h"

namespace woodlouse::map {
namespace {

/// A folder of files that goes with the test; the process', for tests run side by side.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" /
              ("map_errors_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "inside");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The error of a map that ends with `more` after a name and a terrain on line 1.
std::string error_with(const std::string& more) {
  const auto map =
      parse_map("{\"name\":\"m\",\"terrain\":{\"function\":\"volcano\"}" + more + "}", "m.json", {});
  return map ? std::string("no error") : map.error().text();
}

std::string error_of(std::string_view text) {
  const auto map = parse_map(text, "m.json", {});
  return map ? std::string("no error") : map.error().text();
}

std::string terrain_error(const std::string& terrain) {
  return error_of("{\"name\":\"m\",\n\"terrain\":" + terrain + "}");
}

const std::string kFlat = "[0,0,0,0],\n[0,0,0,0],\n[0,0,0,0],\n[0,0,0,0]";
const std::string kGrid =
    "ncols 4 nrows 4 xllcorner 0 yllcorner 0 cellsize 1\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\n";

}  // namespace

TEST_CASE("every physics field is checked against its range, with its line and unit") {
  struct Field {
    const char* name;
    const char* low;
    const char* high;
    const char* range;
  };
  const Field fields[] = {{"gravity", "-0.5", "1000.5", "0 to 1000 m/s^2"},
                          {"drag", "-0.5", "100.5", "0 to 100 1/s"},
                          {"friction", "-0.5", "10.5", "0 to 10"},
                          {"thrust_max", "-0.5", "1000.5", "0 to 1000 m/s^2"},
                          {"edge_restitution", "-0.5", "1.5", "0 to 1"}};
  for (const Field& field : fields) {
    for (const char* value : {field.low, field.high}) {
      const std::string error =
          error_with(",\n\n\"physics\":{\n\"" + std::string(field.name) + "\":" + value + "}");
      INFO(error);
      CHECK(error.find("m.json:4: physics." + std::string(field.name) + ": " + value) == 0);
      CHECK(error.find(field.range) != std::string::npos);
    }
    for (const char* value : {"\"1\"", "null", "[1]", "{}", "true"}) {
      const std::string error =
          error_with(",\n\n\"physics\":{\n\"" + std::string(field.name) + "\":" + value + "}");
      INFO(error);
      CHECK(error.find("m.json:4: physics." + std::string(field.name) + ": a number is wanted, not") == 0);
    }
    for (const char* value : {"0", "1", "1e-300", "0.25"}) {
      CHECK(error_with(",\"physics\":{\"" + std::string(field.name) + "\":" + value + "}") == "no error");
    }
  }
}

TEST_CASE("an unknown key is an error that guesses what was meant") {
  CHECK(error_with(",\n\"phisics\":{}") == "m.json:2: phisics: is not known (did you mean \"physics\"?)");
  CHECK(error_with(",\n\"physics\":{\"draag\":1}") ==
        "m.json:2: physics.draag: is not known (did you mean \"drag\"?)");
  CHECK(error_with(",\n\"colour\":1") ==
        "m.json:2: colour: is not known (known here: name terrain surface edges physics spawns race forage "
        "hill)");
  CHECK(terrain_error("{\"function\":\"hills\",\n\"gird\":3}") ==
        "m.json:3: terrain.gird: is not known (did you mean \"grid\"?)");
  CHECK(error_with(",\"spawns\":[{\"position\":[0,0],\n\"haeding\":1}]") ==
        "m.json:2: spawns[0].haeding: is not known (did you mean \"heading\"?)");
}

TEST_CASE("a map says its name and its terrain, once, and is an object") {
  CHECK(error_of("{\n\"terrain\":{\"function\":\"hills\"}}") == "m.json:1: \"name\" is missing");
  CHECK(error_of("{\"name\":\"m\"}").find("m.json:1: \"terrain\" is missing") == 0);
  CHECK(error_of("{\"name\":\"m\",\n\"name\":\"n\"}") == "m.json:2: name: stands twice (keep one of them)");
  CHECK(error_of("[]") == "m.json:1: an object is wanted, not a list");
  CHECK(error_of("").find("m.json:1: not JSON: ") == 0);
  CHECK(error_of("ncols 4\nnrows 4\n").ends_with("make-map FILE --out MAP.json)"));
  CHECK_FALSE(error_of("{\"name\":").ends_with(")"));
  CHECK(error_of("{\n\"name\":\"\",\"terrain\":{\"function\":\"hills\"}}")
            .find("m.json:2: name: text of 0 bytes") == 0);
  CHECK(error_of("{\n\"name\":\"a\\u001b\",\"terrain\":{\"function\":\"hills\"}}")
            .find("m.json:2: name: text with control") == 0);
  CHECK(error_of("{\n\"name\":\"" + std::string(65, 'x') + "\",\"terrain\":{\"function\":\"hills\"}}")
            .find("m.json:2: name: text of 65 bytes") == 0);
  CHECK(error_of("{\n\"name\":7,\"terrain\":{\"function\":\"hills\"}}") ==
        "m.json:2: name: text is wanted, not a number");
}

TEST_CASE("a surface is one of three and a function surface needs a function") {
  CHECK(error_with(",\n\"surface\":\"splin\"") ==
        "m.json:2: surface: is no kind of surface (did you mean \"spline\"?)");
  CHECK(error_with(",\n\"surface\":3").find("m.json:2: surface: the name of a surface is wanted") == 0);
  CHECK(error_of("{\"name\":\"m\",\"terrain\":{\"spacing\":1,\"heights\":[" + kFlat +
                 "]},\n\"surface\":\"function\"}")
            .find("m.json:5: surface: \"function\" needs a terrain that names a function") == 0);
}

TEST_CASE("a terrain is exactly one of function, file and heights") {
  CHECK(terrain_error("{}") ==
        "m.json:2: terrain: exactly one of function, file and heights is wanted, not 0");
  CHECK(terrain_error("{\"function\":\"hills\",\"heights\":[]}") ==
        "m.json:2: terrain: exactly one of function, file and heights is wanted, not 2");
  CHECK(terrain_error("7") == "m.json:2: terrain: an object is wanted, not a number");
}

TEST_CASE("a function terrain's fields are checked") {
  CHECK(terrain_error("{\n\"function\":\"vulcano\"}") ==
        "m.json:3: terrain.function: is no function we have (did you mean \"volcano\"?)");
  CHECK(terrain_error("{\n\"function\":1}").find("m.json:3: terrain.function: ") == 0);
  for (const char* grid : {"1", "1000", "2.5", "-3", "\"9\"", "1e1"}) {
    const std::string error = terrain_error("{\"function\":\"hills\",\n\"grid\":" + std::string(grid) + "}");
    INFO(error);
    CHECK(error.find("m.json:3: terrain.grid: ") == 0);
    CHECK(error.find("2 to 999") != std::string::npos);
  }
  for (const char* scale : {"0", "-1", "1e6"}) {
    CHECK(terrain_error("{\"function\":\"hills\",\n\"scale\":" + std::string(scale) + "}")
              .find("m.json:3: terrain.scale: ") == 0);
  }
}

TEST_CASE("inline heights are checked one by one") {
  const auto heights = [](const std::string& rows, const std::string& more = "\"spacing\":1") {
    return terrain_error("{" + more + ",\"heights\":[\n" + rows + "]}");
  };
  CHECK(heights(kFlat) == "no error");
  CHECK(heights("[0,0,0,0],\n[0,0,true,0],\n[0,0,0,0],\n[0,0,0,0]") ==
        "m.json:4: terrain.heights[1][2]: a number is wanted, not true or false");
  CHECK(heights("[0,0,0,0],\n[0,0,0],\n[0,0,0,0],\n[0,0,0,0]") ==
        "m.json:4: terrain.heights[1]: 3 heights, the first row has 4");
  CHECK(heights("[0,0,0,0],\n[0,0,0,2e6],\n[0,0,0,0],\n[0,0,0,0]")
            .find("m.json:4: terrain.heights[1][3]: 2e+06 m is out of range") == 0);
  CHECK(heights("[0,0,0,0],[0,0,0,0],[0,0,0,0]").find("m.json:2: terrain.heights: at least 4 rows") == 0);
  CHECK(
      heights("[0,0,0],[0,0,0],[0,0,0],[0,0,0]").find("m.json:3: terrain.heights[0]: a row of at least 4") ==
      0);
  CHECK(heights("[0,0,0,0],[0,0,0,500],[0,0,0,0],[0,0,0,0]")
            .find("m.json:2: terrain: column 4 from the west, row 1 from the south: steeper") == 0);
  CHECK(heights(kFlat, "\"spacing\":0").find("m.json:2: terrain.spacing: 0 m is out of range") == 0);
  CHECK(heights(kFlat, "\"spacing\":[1,-1]").find("m.json:2: terrain.spacing[1]: -1 m is out of range") == 0);
  CHECK(heights(kFlat, "\"spacing\":[1]").find("m.json:2: terrain.spacing: a pair [x, y] is wanted") == 0);
  CHECK(heights(kFlat, "\"origin\":[0,0]").find("m.json:2: terrain: \"spacing\" is missing") == 0);
  CHECK(heights(kFlat, "\"spacing\":1,\"origin\":[0,1e8]").find("m.json:2: terrain.origin[1]: ") == 0);
  CHECK(heights(kFlat, "\"spacing\":1,\"scale\":1e-5").find("m.json:2: terrain: knots less than 1 mm") == 0);
  CHECK(heights(kFlat, "\"spacing\":1,\"origin\":[0,1e7],\"scale\":10")
            .find("m.json:2: terrain: the origin is more than") == 0);
}

TEST_CASE("spawn points lie on the map and look somewhere") {
  CHECK(error_with(",\"spawns\":[{\"position\":[0,0]},\n{\"position\":[20.5,0]}]") ==
        "m.json:2: spawns[1].position: lies outside the map (x -20 to 20 m, y -20 to 20 m)");
  CHECK(error_with(",\"spawns\":[\n{\"heading\":3}]").find("m.json:2: spawns[0]: \"position\" is missing") ==
        0);
  CHECK(error_with(",\"spawns\":[{\"position\":[0,0],\n\"heading\":[0,0]}]") ==
        "m.json:2: spawns[0].heading: a heading of length 0 points nowhere");
  CHECK(error_with(",\"spawns\":[{\"position\":[0,0],\n\"heading\":361}]")
            .find("m.json:2: spawns[0].heading: 361 degrees is out of range") == 0);
  CHECK(error_with(",\"spawns\":[{\"position\":[0,0],\n\"heading\":\"north\"}]")
            .find("m.json:2: spawns[0].heading: degrees or a pair") == 0);
  CHECK(error_with(",\n\"spawns\":[]").find("m.json:2: spawns: a list of 1 to 1024") == 0);
  CHECK(error_with(",\n\"spawns\":{}").find("m.json:2: spawns: a list of 1 to 1024") == 0);
}

TEST_CASE("a map is read by its limits") {
  CHECK(error_of("{\"name\":\"m\",\"terrain\":[[[[[[[[[]]]]]]]]]}") == "m.json:1: nested more than 8 deep");
  CHECK(error_of(std::string(kMaxMapBytes + 1, ' ')) == "m.json: longer than 128 MiB");
}

TEST_CASE("check tells every problem of a map and of its grid") {
  const Folder folder;
  folder.write(
      "hole.asc",
      "ncols 4 nrows 4 xllcorner 0 yllcorner 0 cellsize 1\n1 2 nan 4\n5 6 7 8\n9 x 11 12\n13 14 15 16\n");
  const auto file =
      folder.write("bad.json",
                   "{\n\"terrain\":{\"file\":\"hole.asc\"},\n\"physics\":{\"drag\":-1,\n\"gravty\":3},\n"
                   "\"spawns\":[{\"position\":[0]}]\n}");
  std::vector<std::string> texts;
  for (const core::Error& error : check_map(file)) texts.push_back(error.text());
  const std::string json = file.string();
  const std::string grid = (folder.path() / "hole.asc").string();
  REQUIRE(texts.size() == 5);
  CHECK(texts[0] == json + ":1: \"name\" is missing");
  CHECK(texts[1].find(grid + ":4: row 3, column 2: \"x\" is no number") == 0);
  CHECK(texts[2] == json + ":4: physics.gravty: is not known (did you mean \"gravity\"?)");
  CHECK(texts[3].find(json + ":3: physics.drag: -1 1/s is out of range") == 0);
  CHECK(texts[4].find(json + ":5: spawns[0].position: a pair [x, y] is wanted") == 0);
}

TEST_CASE("of many faults the first hundred are told, and how many more there are") {
  const Folder folder;
  std::string keys;
  for (int k = 0; k < 137; ++k) keys += ",\n\"key" + std::to_string(k) + "\":0";
  const auto file = folder.write("m.json", R"({"name":"m","terrain":{"function":"hills"})" + keys + "}");
  const auto errors = check_map(file);
  REQUIRE(errors.size() == 101);
  CHECK(errors[99].text().find(file.string() + ":101: key99: is not known") == 0);
  CHECK(errors[100].text() == file.string() + ": and 37 more");

  std::string rows;
  for (int k = 0; k < 15 * 10; ++k) rows += "7x ";
  folder.write("bad.asc", "ncols 15\nnrows 10\ncellsize 1\nxllcorner 0\nyllcorner 0\n" + rows);
  const auto grid = folder.write("g.json", R"({"nme":"m","terrain":{"file":"bad.asc"}})");
  CHECK(check_map(grid).size() == 3);  // "name" is missing, "nme" is not known, and one of the grid, not 150
}

TEST_CASE("a grid file never leaves the map's folder") {
  const Folder folder;
  folder.write("good.asc", kGrid);
  folder.write("inside/good.asc", kGrid);
  std::filesystem::create_symlink(WOODLOUSE_SOURCE_DIR "/maps/maunga_whau.asc", folder.path() / "link.asc");
  const auto error_for = [&](const std::string& name) {
    const auto file = folder.write("m.json", "{\"name\":\"m\",\n\"terrain\":{\"file\":\"" + name + "\"}}");
    const auto map = load_map(file);
    return map ? std::string("no error") : map.error().text().substr(file.string().size());
  };
  CHECK(error_for("good.asc") == "no error");
  CHECK(error_for("inside/good.asc") == "no error");
  CHECK(error_for("../" + folder.path().filename().string() + "/good.asc")
            .find(":2: terrain.file: leaves the map's folder") == 0);
  CHECK(error_for("/etc/passwd").find(":2: terrain.file: leaves the map's folder") == 0);
  CHECK(error_for("link.asc") == ":2: terrain.file: " + (folder.path() / "link.asc").string() +
                                     ": leads out of its folder (put the file itself there, not a link)");
  CHECK(error_for("none.asc")
            .find(":2: terrain.file: " + (folder.path() / "none.asc").string() + ": no such file") == 0);
  CHECK(error_for("inside").find("is a folder, not a file") != std::string::npos);
  // A text from a wire has no folder.
  CHECK(terrain_error("{\"file\":\"good.asc\"}")
            .find("m.json:2: terrain.file: a map that comes without a folder") == 0);
}

TEST_CASE("a map file that is not there says so") {
  const auto map = load_map("no/such/map.json");
  REQUIRE_FALSE(map);
  CHECK(map.error().text() ==
        "no/such/map.json: no such file (check the path, and the folder it starts from)");
  CHECK(check_map("no/such/map.json").size() == 1);
}

TEST_CASE("no prefix and no flipped byte of a map does harm") {
  const std::string whole =
      "{\"name\":\"m\",\"terrain\":{\"origin\":[0,1],\"spacing\":[1,2.5],\"scale\":2,\"heights\":[" + kFlat +
      "]},\"surface\":\"natural_spline\",\"physics\":{\"drag\":0.25},\"spawns\":[{\"position\":[1,2],"
      "\"heading\":-45}]}";
  REQUIRE(error_of(whole) == "no error");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CHECK_FALSE(parse_map(std::string_view(whole).substr(0, length), "m.json", {}));
  }
  core::Random random(17);
  for (int round = 0; round < 20000; ++round) {
    std::string text = whole;
    for (std::uint64_t k = random.next() % 3; k <= 2; ++k) {
      text[random.next() % text.size()] = static_cast<char>(random.next() & 0xff);
    }
    const auto map = parse_map(text, "m.json", {});
    if (!map) CHECK(map.error().where.find("m.json") == 0);
  }
}

}  // namespace woodlouse::map
