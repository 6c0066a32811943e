#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "shared/core/input_file.h"
#include "shared/core/sink_file.h"
#include "shared/core/whole_file.h"

using namespace woodlouse::core;
namespace fs = std::filesystem;

namespace {

/// An empty folder, gone afterwards.
struct Folder {
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path path = fs::temp_directory_path() / ("woodlouse_files_test_" + std::to_string(::getpid()));
};

std::string text_of(const fs::path& file) { return read_whole_file(file, 1u << 20).value(); }

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

}  // namespace

TEST_CASE("what is no regular file is refused before it is opened") {
  const Folder folder;
  const fs::path pipe = folder.path / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const auto refusal = [](const fs::path& file) { return read_whole_file(file, 10).error().text(); };
  CHECK(refusal(pipe) == pipe.string() + ": is no regular file (pipes, devices and sockets are not read)");
  CHECK(refusal("/dev/zero").find("/dev/zero: is no regular file") == 0);
  CHECK(refusal(folder.path) == folder.path.string() + ": is a folder, not a file");
  CHECK(refusal(folder.path / "none").find("none: no such file") != std::string::npos);
  write(folder.path / "good", "0123456789");
  CHECK(text_of(folder.path / "good") == "0123456789");
  write(folder.path / "long", "0123456789a");
  CHECK(refusal(folder.path / "long").find("longer than") != std::string::npos);
  fs::create_symlink(pipe, folder.path / "link");
  CHECK(refusal(folder.path / "link").find("is no regular file") != std::string::npos);
}

TEST_CASE("a file is replaced as a whole, keeps its mode, and nothing is left beside it") {
  const Folder folder;
  const fs::path file = folder.path / "kept";
  REQUIRE(replace_whole_file(file, "first"));
  CHECK(text_of(file) == "first");
  REQUIRE(::chmod(file.c_str(), 0644) == 0);
  REQUIRE(replace_whole_file(file, std::string(300'000, 'x')));
  CHECK(text_of(file).size() == 300'000);
  CHECK(fs::status(file).permissions() == static_cast<fs::perms>(0644));
  const auto refused = replace_whole_file(folder.path / "none" / "kept", "x");
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what.find("can't be written: ") == 0);
  fs::create_directory(folder.path / "folder");
  CHECK_FALSE(replace_whole_file(folder.path / "folder", "x"));
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 2);
}

TEST_CASE("a number stands before the extension, packed or not") {
  CHECK(numbered("game.ndjson", 1) == "game.1.ndjson");
  CHECK(numbered("nights/game.volcano.ndjson.zst", 12) == "nights/game.volcano.12.ndjson.zst");
  CHECK(numbered("game", 3) == "game.3");
  CHECK(numbered("game.zst", 3) == "game.3.zst");
}

TEST_CASE("a file that is there is never written over: the next one is numbered") {
  const Folder folder;
  const fs::path file = folder.path / "game.ndjson";
  const char* const names[] = {"game.ndjson", "game.1.ndjson", "game.2.ndjson"};
  for (const char* name : names) {
    const auto created = create_file(file);
    REQUIRE(created);
    CHECK(created->path == folder.path / name);
    CHECK(created->sink->write(name).has_value());
    CHECK(created->sink->write("!").has_value());
    CHECK(created->sink->close().has_value());
  }
  for (const char* name : names) CHECK(text_of(folder.path / name) == std::string(name) + "!");
  fs::remove(folder.path / "game.1.ndjson");
  fs::create_symlink(folder.path / "nowhere", folder.path / "game.1.ndjson");  // a name that is taken, too
  CHECK(create_file(file)->path == folder.path / "game.3.ndjson");
  CHECK_FALSE(fs::exists(folder.path / "nowhere"));
}

TEST_CASE("a name that is too long is told, and whether its number makes it so") {
  const Folder folder;
  CHECK(create_file(folder.path / std::string(256, 'n')).error().hint == "take a shorter one");
  const fs::path longest = folder.path / std::string(255, 'n');
  REQUIRE(create_file(longest));
  const auto second = create_file(longest);
  REQUIRE_FALSE(second);
  CHECK(second.error().what == "File name too long");
  CHECK(second.error().hint == "there is one without a number, and this is too long: take a shorter one");
}

TEST_CASE("what can't be written into is told, and nobody waits for a pipe's reader") {
  const Folder folder;
  CHECK(create_file(folder.path).error().text() ==
        folder.path.string() + ": Is a directory (name a file in it)");
  CHECK(create_file(folder.path / "none" / "game").error().what == "No such file or directory");
  const fs::path pipe = folder.path / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_FALSE(create_file(pipe));
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  REQUIRE(reader >= 0);
  const auto created = create_file(pipe);
  REQUIRE(created);
  CHECK(created->sink->write("heard").has_value());
  char bytes[8] = {};
  CHECK(::read(reader, bytes, sizeof bytes) == 5);
  // Full, and read from no more: told, not waited for.
  const std::string much(1u << 20, 'x');
  CHECK(created->sink->write(much).error().what == "nobody reads it");
  ::close(reader);
  const auto full = create_file("/dev/full");
  REQUIRE(full);
  CHECK(full->sink->write("x").error().text() == "/dev/full: No space left on device");
}

TEST_CASE("what somebody else named is opened in its folder alone, wherever links lead") {
  const Folder outer;
  const fs::path folder = outer.path / "came";
  fs::create_directories(folder / "deep");
  write(outer.path / "secret", "secret");
  write(folder / "map", "map");
  write(folder / "deep" / "grid", "grid");
  fs::create_directory_symlink(outer.path, folder / "up");
  fs::create_directory_symlink("deep", folder / "also_deep");
  fs::create_symlink(outer.path / "secret", folder / "out");
  fs::create_symlink("/proc/self/environ", folder / "process");
  fs::create_symlink("map", folder / "near");
  fs::create_symlink(folder / "map", folder / "absolute");
  fs::create_symlink("none", folder / "dangling");
  const auto read = [&](const fs::path& name) { return read_whole_file_within(folder, folder / name, 100); };
  const std::pair<const char*, const char*> inside[] = {{"map", "map"},
                                                        {"deep/grid", "grid"},
                                                        {"also_deep/grid", "grid"},
                                                        {"near", "map"},
                                                        {"absolute", "map"}};
  for (const auto& [name, text] : inside) CHECK(read(name).value() == text);
  for (const char* name : {"out", "up/secret", "process", "../secret", "up/came/../secret"}) {
    const auto refused = read(name);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().text() ==
          (folder / name).string() + ": leads out of its folder (put the file itself there, not a link)");
  }
  CHECK(read("dangling").error().what == "no such file");
  CHECK(read("map/x").error().what == "no such file");
  CHECK(read("deep").error().what == "is a folder, not a file");
  CHECK(read(".").error().what == "is a folder, not a file");
  const fs::path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(read("pipe").error().what == "is no regular file");
  CHECK(read_whole_file(folder / "out", 100).value() == "secret");  // the user's own links are his
}

TEST_CASE("a file that the system makes up is read without waiting, to its end or to the bound") {
  CHECK(read_whole_file("/proc/self/status", 1u << 20).value().find("Name:") == 0);
  CHECK(read_whole_file("/proc/self/pagemap", 1u << 20).error().what == "longer than 1 MiB");
  const auto input = InputFile::open("/proc/self/status");
  REQUIRE(input);
  CHECK((::fcntl(input->descriptor(), F_GETFL) & O_NONBLOCK) != 0);
}
