// The page's files, by path: what of web/page was built into the program, or a folder for who works on it.
// Nothing of what a request says is a path on the disk before it was looked at, name by name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::server {

/// One that is answered.
struct PageFile {
  std::string_view type;   ///< of its content
  std::string_view bytes;  ///< as long as the PageFiles live; empty: they stand in `read`
  std::string read;
  std::string etag;          ///< in quotes; another one for the packed bytes; empty: none
  bool is_packed = false;    ///< gzip
  bool is_for_good = false;  ///< what the path names never changes
  bool varies = false;       ///< with what the client unpacks
  [[nodiscard]] std::string_view content() const {
    return bytes.data() != nullptr ? bytes : std::string_view(read);
  }
};

/// Any thread may ask.
class PageFiles {
 public:
  PageFiles() = default;
  PageFiles(const PageFiles&) = delete;
  PageFiles& operator=(const PageFiles&) = delete;
  virtual ~PageFiles() = default;

  /// path: of a request, without its query; "/" is the page itself. Nothing: there is no such file.
  [[nodiscard]] virtual std::optional<PageFile> find(std::string_view path, bool may_be_packed) const = 0;
};

/// As the build has put it into the program; cmake/pack_page.sh makes the table.
struct EmbeddedFile {
  std::string_view name;  ///< core/core.js
  std::string_view bytes;
  std::string_view packed;  ///< by gzip; empty: not smaller
};
struct EmbeddedPage {
  std::string_view version;  ///< of all files together; "": none are built in
  std::span<const EmbeddedFile> files;
};
/// What was built in.
[[nodiscard]] EmbeddedPage embedded_page();

/// Those that were built in: `/` is index.html, every file stands below /VERSION/. Null: none are.
[[nodiscard]] std::unique_ptr<const PageFiles> built_in_pages(const EmbeddedPage& page);

/// Those of a folder, read anew for each request; its names are of letters, digits, `.`, `_` and `-` and
/// don't begin with a point, and none may be a link. What is not in it (core.wasm) is taken from `besides`.
/// Errors: where = --web-root.
[[nodiscard]] core::Expected<std::unique_ptr<const PageFiles>> folder_pages(
    const std::filesystem::path& folder, const EmbeddedPage& besides);

/// Of a folder where one is named, else the built in ones; null: there are none. Errors: as folder_pages().
[[nodiscard]] core::Expected<std::unique_ptr<const PageFiles>> chosen_pages(
    const std::optional<std::filesystem::path>& folder);

/// What a name's ending says; for others none is known: application/octet-stream.
[[nodiscard]] std::string_view content_type(std::string_view name);

/// Of a request's Accept-Encoding.
[[nodiscard]] bool takes_gzip(std::string_view accept_encoding);
/// Of a request's If-None-Match: whether the client has it. `etag`: in quotes.
[[nodiscard]] bool has_already(std::string_view if_none_match, std::string_view etag);

}  // namespace woodlouse::server
