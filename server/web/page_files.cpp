#include "server/web/page_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

using core::joined;

constexpr std::string_view kIndex = "index.html";
constexpr std::size_t kMostBytes = std::size_t{64} << 20;  // of a file in a folder

/// The part before the first `separator`, which is taken away with it.
std::string_view take_part(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

/// Nothing: there is none of that name.
std::optional<PageFile> file_of(const EmbeddedPage& page, std::string_view name, bool may_be_packed) {
  const auto found = std::find_if(page.files.begin(), page.files.end(),
                                  [&](const EmbeddedFile& file) { return file.name == name; });
  if (found == page.files.end()) return std::nullopt;
  PageFile result;
  result.type = content_type(name);
  result.varies = !found->packed.empty();
  result.is_packed = may_be_packed && result.varies;
  result.bytes = result.is_packed ? found->packed : found->bytes;
  result.etag = joined({"\"", page.version, result.is_packed ? "-gzip\"" : "\""});
  return result;
}

class BuiltInPages final : public PageFiles {
 public:
  explicit BuiltInPages(const EmbeddedPage& page) : page_(page) { assert(!page.version.empty()); }

  [[nodiscard]] std::optional<PageFile> find(std::string_view path, bool may_be_packed) const override {
    if (path == "/" || path == "/index.html") return file_of(page_, kIndex, may_be_packed);
    if (!path.starts_with('/')) return std::nullopt;
    path.remove_prefix(1);
    if (take_part(path, '/') != page_.version) return std::nullopt;
    auto file = file_of(page_, path, may_be_packed);
    if (file) file->is_for_good = true;
    return file;
  }

 private:
  EmbeddedPage page_;
};

bool is_plain_name(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), is_plain);
}

/// An open file, or none.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

class FolderPages final : public PageFiles {
 public:
  FolderPages(Descriptor folder, const EmbeddedPage& besides)
      : folder_(std::move(folder)), besides_(besides) {}

  [[nodiscard]] std::optional<PageFile> find(std::string_view path, bool may_be_packed) const override {
    if (!path.starts_with('/')) return std::nullopt;
    path.remove_prefix(1);
    const std::string_view name = path.empty() ? kIndex : path;
    if (auto bytes = read(name)) {
      PageFile file;
      file.type = content_type(name);
      file.read = std::move(*bytes);
      return file;
    }
    return name == kIndex ? std::nullopt : file_of(besides_, name, may_be_packed);
  }

 private:
  /// Folder by folder, none of them a link. Nothing: it is not there, no file, or too large.
  [[nodiscard]] std::optional<std::string> read(std::string_view path) const {
    Descriptor at(::dup(folder_.number()));
    while (at.is_open()) {
      const bool is_last = path.find('/') == std::string_view::npos;
      const std::string name(take_part(path, '/'));
      if (!is_plain_name(name)) return std::nullopt;
      const int how = O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (is_last ? 0 : O_DIRECTORY);
      at = Descriptor(::openat(at.number(), name.c_str(), how));
      if (is_last) return contents(at);
    }
    return std::nullopt;
  }
  static std::optional<std::string> contents(const Descriptor& file) {
    struct stat facts {};
    if (!file.is_open() || ::fstat(file.number(), &facts) != 0 || !S_ISREG(facts.st_mode))
      return std::nullopt;
    std::string bytes;
    std::array<char, 65536> part;
    while (bytes.size() <= kMostBytes) {
      const ssize_t size = ::read(file.number(), part.data(), part.size());
      if (size == 0) return bytes;
      if (size < 0 && errno == EINTR) continue;
      if (size < 0) return std::nullopt;
      bytes.append(part.data(), static_cast<std::size_t>(size));
    }
    return std::nullopt;
  }

  Descriptor folder_;
  EmbeddedPage besides_;
};

}  // namespace

std::unique_ptr<const PageFiles> built_in_pages(const EmbeddedPage& page) {
  if (page.version.empty()) return nullptr;
  return std::make_unique<const BuiltInPages>(page);
}

core::Expected<std::unique_ptr<const PageFiles>> folder_pages(const std::filesystem::path& folder,
                                                              const EmbeddedPage& besides) {
  Descriptor open(::open(folder.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY));
  if (!open.is_open())
    return core::fail("--web-root", joined({folder.string(), ": ", std::strerror(errno)}),
                      "give the folder that index.html is in:  --web-root web/page");
  return std::make_unique<const FolderPages>(std::move(open), besides);
}

core::Expected<std::unique_ptr<const PageFiles>> chosen_pages(
    const std::optional<std::filesystem::path>& folder) {
  if (folder) return folder_pages(*folder, embedded_page());
  return built_in_pages(embedded_page());
}

std::string_view content_type(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".json", "application/json"},
      {".txt", "text/plain; charset=utf-8"},
  };
  for (const auto& [ending, type] : kTypes)
    if (name.ends_with(ending)) return type;
  return "application/octet-stream";
}

bool takes_gzip(std::string_view accept_encoding) {
  bool takes_any = false;
  while (!accept_encoding.empty()) {
    std::string_view one = take_part(accept_encoding, ',');
    const std::string_view name = trimmed(take_part(one, ';'));
    std::string_view weight = trimmed(one);
    const bool is_refused =
        weight.starts_with("q=0") && weight.find_first_not_of("0.", 2) == std::string_view::npos;
    if (name == "gzip" || name == "x-gzip") return !is_refused;
    if (name == "*") takes_any = !is_refused;
  }
  return takes_any;
}

bool has_already(std::string_view if_none_match, std::string_view etag) {
  while (!if_none_match.empty()) {
    std::string_view one = trimmed(take_part(if_none_match, ','));
    if (one.starts_with("W/")) one.remove_prefix(2);
    if (one == "*" || one == etag) return !etag.empty();
  }
  return false;
}

}  // namespace woodlouse::server
