#include "server/watchers/recording_files.h"

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("woodlouse_files_test_" + std::to_string(::getpid()))) {
    fs::create_directory(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Of 1000 bytes, and so many hours old.
  void put(const std::string& name, int hours, std::string text = R"({"format":"woodlouse-replay","x":1)") {
    text.resize(1000, ' ');
    std::ofstream(path_ / name) << text;
    fs::last_write_time(path_ / name, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : fs::directory_iterator(path_)) result.insert(entry.path().filename());
    return result;
  }
  [[nodiscard]] RecordPattern pattern(const std::string& name) const {
    return *RecordPattern::parse((path_ / name).string(), 1);
  }
  [[nodiscard]] fs::path path(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

}  // namespace

TEST_CASE("the oldest finished recordings of the pattern go until all fit, and nothing else does") {
  Folder folder;
  folder.put("g-2020.ndjson", 9);
  folder.put("g-2021.ndjson", 8);
  folder.put("g-2021.1.ndjson", 7);
  folder.put("g-2022.ndjson", 6);
  folder.put("g-1999.ndjson", 99, "somebody's own");
  folder.put("h-2000.ndjson", 99);
  folder.put("g-2000.ndjson.bak", 99);
  fs::create_directory(folder.path("g-2001.ndjson"));
  fs::create_symlink(folder.path("h-2000.ndjson"), folder.path("g-2002.ndjson"));
  std::ofstream(folder.path("g-2003.ndjson"));
  RecordingFiles files(folder.pattern("g-%Y.ndjson"), 3500);
  const auto made = files.create("hills");
  REQUIRE(made);
  auto others = folder.names();

  RecordingFiles::Removed removed = files.make_room(made->path, 500);
  CHECK(removed.files == 1);
  CHECK(removed.bytes == 1000);
  CHECK(removed.last == folder.path("g-2020.ndjson"));
  CHECK(removed.fits);
  others.erase("g-2020.ndjson");
  CHECK(folder.names() == others);

  removed = files.make_room(made->path, 1001);
  CHECK(removed.files == 2);
  CHECK(removed.last == folder.path("g-2021.1.ndjson"));
  CHECK(removed.fits);
  CHECK(files.removed() == 3);

  removed = files.make_room(made->path, 900);
  CHECK(removed.files == 0);
  CHECK(removed.fits);
  removed = files.make_room(made->path, 1000);
  CHECK(removed.files == 1);
  CHECK(removed.fits);
  removed = files.make_room(made->path, 100);
  CHECK(removed.files == 0);
  CHECK_FALSE(removed.fits);
  for (const char* const name : {"g-2021.ndjson", "g-2021.1.ndjson", "g-2022.ndjson"}) others.erase(name);
  CHECK(folder.names() == others);
}

TEST_CASE("what is being written is never removed: of this server, of another, or of the one who asks") {
  Folder folder;
  RecordingFiles other(folder.pattern("{room}.ndjson"));
  const auto others = other.create("elsewhere");
  REQUIRE(others);
  REQUIRE(others->sink->write(R"({"format":"woodlouse-replay","x":1)" + std::string(1000, ' ')));
  fs::last_write_time(others->path, fs::file_time_type::clock::now() - std::chrono::hours(1));
  RecordingFiles files(folder.pattern("{room}.ndjson"), 3000);
  const auto first = files.create("first");
  const auto second = files.create("second");
  REQUIRE((first && second));
  CHECK(files.make_room(first->path, 1500).fits);
  // What is too much is the largest's fault.
  RecordingFiles::Removed removed = files.make_room(second->path, 1000);
  CHECK(removed.fits);
  CHECK(removed.files == 0);
  removed = files.make_room(first->path, 1);
  CHECK_FALSE(removed.fits);
  CHECK(removed.files == 0);
  CHECK(folder.names().size() == 3);
  // Until they are closed.
  REQUIRE(others->sink->close());
  removed = files.make_room(first->path, 1);
  CHECK(removed.fits);
  CHECK(removed.files == 1);
  CHECK(removed.last == folder.path("elsewhere.ndjson"));
}

TEST_CASE("without a bound nothing is looked at, without a folder nothing is made") {
  Folder folder;
  folder.put("g-2020.ndjson", 9);
  RecordingFiles files(folder.pattern("g-%Y.ndjson"));
  const auto made = files.create("hills");
  REQUIRE(made);
  CHECK(files.make_room(made->path, std::uint64_t{1} << 50).fits);
  CHECK(folder.names().size() == 2);
  const auto refused = RecordingFiles(folder.pattern("none/g")).create("hills");
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().text(),
             Catch::Contains("its folder is not there") && Catch::Contains("mkdir -p"));
  CHECK(folder.names().size() == 2);
}
