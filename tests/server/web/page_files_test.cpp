#include "server/web/page_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace woodlouse::server::page_files_test {

namespace {

constexpr std::array kFiles = {
    EmbeddedFile{"index.html", "<script src=\"/00c0ffee00c0ffee/page.js\">", ""},
    EmbeddedFile{"core/core.js", "export class Core {}", "packed"},
    EmbeddedFile{"core.wasm", "\0asm", "p"},
};
const EmbeddedPage kPage{"00c0ffee00c0ffee", kFiles};

/// A folder that ends with the test.
struct Folder {
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "woodlouse-page-XXXXXX").string();
    path = ::mkdtemp(name.data());
    write("index.html", "<!doctype html>");
    std::filesystem::create_directory(path / "core");
    write("core/core.js", "export {};");
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void write(const std::string& name, std::string_view text) const { std::ofstream(path / name) << text; }
  std::filesystem::path path;
};

}  // namespace

TEST_CASE("the page is at /, and each of its files for good below their version") {
  const auto pages = built_in_pages(kPage);
  REQUIRE(pages != nullptr);
  const auto index = pages->find("/", true);
  REQUIRE(index);
  CHECK(index->content() == kFiles[0].bytes);
  CHECK(index->type == "text/html; charset=utf-8");
  CHECK_FALSE(index->is_for_good);
  CHECK_FALSE(index->is_packed);  // there are no packed bytes that are fewer
  const auto script = pages->find("/00c0ffee00c0ffee/core/core.js", false);
  REQUIRE(script);
  CHECK(script->content() == kFiles[1].bytes);
  CHECK(script->type == "text/javascript; charset=utf-8");
  CHECK(script->is_for_good);
  const auto packed = pages->find("/00c0ffee00c0ffee/core/core.js", true);
  REQUIRE(packed);
  CHECK((packed->is_packed && packed->content() == "packed" && packed->varies && script->varies));
  CHECK(packed->etag != script->etag);
  CHECK(pages->find("/00c0ffee00c0ffee/core.wasm", false)->type == "application/wasm");
}

TEST_CASE("what is no file of the page is not found") {
  const auto pages = built_in_pages(kPage);
  for (const auto* path :
       {"", "index.html", "/core/core.js", "/00c0ffee00c0ffef/core/core.js", "/00c0ffee00c0ffee/",
        "/00c0ffee00c0ffee", "//00c0ffee00c0ffee/core.wasm", "/00c0ffee00c0ffee//core.wasm",
        "/00c0ffee00c0ffee/../00c0ffee00c0ffee/core.wasm", "/00c0ffee00c0ffee/core.wasm/"})
    CHECK_FALSE(pages->find(path, true));
  CHECK(built_in_pages({}) == nullptr);
}

TEST_CASE("a folder is served as it is now, and what it has not as it was built in") {
  const Folder folder;
  auto made = folder_pages(folder.path, kPage);
  REQUIRE(made);
  const PageFiles& pages = **made;
  CHECK(pages.find("/", true)->content() == "<!doctype html>");
  CHECK(pages.find("/core/core.js", true)->content() == "export {};");
  CHECK_FALSE(pages.find("/core/core.js", true)->is_for_good);
  folder.write("core/core.js", "export const two = 2;");
  CHECK(pages.find("/core/core.js", true)->content() == "export const two = 2;");
  CHECK(pages.find("/core.wasm", false)->content() == kFiles[2].bytes);
  std::filesystem::remove(folder.path / "index.html");
  CHECK_FALSE(pages.find("/", true));
}

TEST_CASE("nothing outside of the folder is served, by whatever name it is asked for") {
  const Folder folder;
  const std::filesystem::path inside = folder.path / "inside";
  std::filesystem::create_directory(inside);
  folder.write("secret.txt", "secret");
  folder.write("inside/.hidden", "secret");
  std::filesystem::create_symlink(folder.path / "secret.txt", inside / "link.txt");
  std::filesystem::create_symlink(folder.path, inside / "up");
  REQUIRE(::mkfifo((inside / "pipe").c_str(), 0600) == 0);
  auto made = folder_pages(inside, {});
  REQUIRE(made);
  for (const auto* path : {"/../secret.txt", "/./../secret.txt", "/link.txt", "/up/secret.txt", "/.hidden",
                           "/pipe", "//secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
                           "/..\\secret.txt", "/up", "/", "", "secret.txt", "/etc/passwd"})
    CHECK_FALSE((*made)->find(path, true));
  CHECK_FALSE((*made)->find(std::string_view("/a\0b", 4), true));
  CHECK_FALSE((*made)->find("/" + std::string(5000, 'a'), true));
}

TEST_CASE("a folder that is none is told by its name") {
  const auto made = folder_pages("/nowhere/at/all", kPage);
  REQUIRE_FALSE(made);
  CHECK(made.error().where == "--web-root");
  CHECK(made.error().what.find("/nowhere/at/all") != std::string::npos);
}

TEST_CASE("who says that he unpacks gzip gets it packed") {
  for (const auto* yes : {"gzip", "deflate, gzip;q=0.8, br", "br,gzip", "*", "x-gzip", "gzip;q=1"})
    CHECK(takes_gzip(yes));
  for (const auto* no : {"", "br", "gzip;q=0", "gzip; q=0.000", "identity", "*;q=0", "gzipped"})
    CHECK_FALSE(takes_gzip(no));
}

TEST_CASE("what the client has is compared by its mark") {
  const std::string etag = "\"00c0ffee00c0ffee\"";
  for (const std::string& yes : {etag, "W/" + etag, "\"a\", " + etag, std::string("*")})
    CHECK(has_already(yes, etag));
  for (const auto* no : {"", "\"a\"", "00c0ffee00c0ffee", "\"00c0ffee00c0ffee-gzip\""})
    CHECK_FALSE(has_already(no, etag));
  CHECK_FALSE(has_already("*", ""));
}

}  // namespace woodlouse::server::page_files_test
