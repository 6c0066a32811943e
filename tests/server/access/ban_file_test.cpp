#include "server/access/ban_file.h"

#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "server/access/secret.h"

namespace woodlouse::server::ban_file_test {

namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

const WallTime kNow{seconds(1'767'225'600)};

struct Folder {
  Folder() {
    std::string name = (fs::temp_directory_path() / "woodlouse_bans_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
  fs::path path;
};

std::string bytes_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("bans are read back as they were written, by their owner alone") {
  const Folder folder;
  const fs::path file = folder.path / "bans";
  REQUIRE(read_bans(file));
  CHECK(read_bans(file)->all().empty());
  Bans bans;
  REQUIRE(bans.add(*Bans::parse("192.0.2.0/24", kNow, kNow + seconds(60))));
  REQUIRE(bans.add(*Bans::parse("2001:db8:1234:5678:9abc:def0:1234:5678", kNow, {})));
  REQUIRE(bans.add(*Bans::parse("\"ann\" \xc3\xa9", kNow, {})));
  REQUIRE(write_bans(file, bans));
  struct stat there {};
  REQUIRE(::stat(file.c_str(), &there) == 0);
  CHECK((there.st_mode & 0777) == 0600);
  CHECK_FALSE(fs::exists(folder.path / "bans.new"));
  const auto back = read_bans(file);
  REQUIRE(back);
  REQUIRE(back->all().size() == 3);
  CHECK(back->all()[0].who() == "192.0.2.0/24");
  CHECK(back->all()[0].until == kNow + seconds(60));
  CHECK(back->all()[1].who() == "2001:db8:1234:5678::/64");
  CHECK_FALSE(back->all()[1].until);
  CHECK(back->all()[2].name == "\"ann\" \xc3\xa9");
  CHECK(back->all()[2].since == kNow);
}

TEST_CASE("a ban's line that can't be taken is named, and no ban of the file holds") {
  const Folder folder;
  for (const char* line :
       {R"({"address":"192.0.)", R"({"address":"ann"})", R"({"address":"0.0.0.0/0"})", R"({"name":""})", "[]",
        "7", R"({"name":"ann","address":"192.0.2.7"})", R"({"until":7})", R"({"name":"ann","until":-1})",
        R"({"name":"ann","until":"soon"})", R"({"name":"ann","untill":7})", R"({"adress":"192.0.2.7"})",
        R"({"nmae":"ann"})", "{}", "\xff"}) {
    const fs::path file = folder.write("bans", std::string("{\"name\":\"bob\"}\n\n") + line + "\n");
    const auto bans = read_bans(file);
    INFO(line);
    REQUIRE_FALSE(bans);
    CHECK(bans.error().where.find("bans:3") != std::string::npos);
  }
  CHECK(read_bans(folder.write("bans", "{\"name\":\"bob\"}"))->all().size() == 1);
  CHECK_FALSE(read_bans(folder.path));
}

TEST_CASE("where bans can't be written the old file stays") {
  const Folder folder;
  const fs::path file = folder.write("bans", "{\"name\":\"bob\"}\n");
  fs::create_directory(folder.path / "bans.new");
  Bans bans;
  REQUIRE(bans.add(*Bans::parse("ann", kNow, {})));
  CHECK_FALSE(write_bans(file, bans));
  CHECK(bytes_of(file) == "{\"name\":\"bob\"}\n");
  CHECK_FALSE(write_bans(folder.path / "nowhere" / "bans", bans));
}

TEST_CASE("a secret is the first line of its file, and matches itself alone") {
  const Folder folder;
  const auto secret = read_secret("--admin-token-file", folder.write("token", "correct-horse\r\n"));
  REQUIRE(secret);
  CHECK(secret->matches("correct-horse"));
  for (const char* other : {"", "correct-hors", "correct-horse ", "Correct-horse", "correct-horse\n"})
    CHECK_FALSE(secret->matches(other));
  for (const std::string& text : {std::string(), std::string("short"), std::string("two words"),
                                  std::string("line-one\nline-two"), std::string(257, 'a')}) {
    const auto none = read_secret("--admin-token-file", folder.write("token", text));
    REQUIRE_FALSE(none);
    if (!text.empty()) CHECK(none.error().text().find(text) == std::string::npos);
  }
}

}  // namespace woodlouse::server::ban_file_test
