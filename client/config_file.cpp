#include "client/config_file.h"

#include <cassert>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "shared/core/whole_file.h"
#include "shared/json/document.h"
#include "shared/json/text.h"

namespace woodlouse::client {
namespace {

constexpr std::size_t kMaxBytes = 1u << 20;

std::filesystem::path folder_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value == '/' ? std::filesystem::path(value) : std::filesystem::path();
}

}  // namespace

std::filesystem::path config_file() {
  if (const auto xdg = folder_of("XDG_CONFIG_HOME"); !xdg.empty()) return xdg / "woodlouse" / "config.json";
  const auto home = folder_of("HOME");
  return home.empty() ? home : home / ".config" / "woodlouse" / "config.json";
}

core::Expected<KeyMap> keys_of(const json::Value& value) {
  if (!value.is(json::Kind::kObject))
    return core::fail("", "it is no object", R"(for example {"up": ["z", "Up"], "quit": "k"})");
  KeyMap map;
  for (const json::Value& action : value.children()) {
    std::vector<std::string> keys;
    if (!action.is(json::Kind::kString) && !action.is(json::Kind::kArray))
      return core::fail(std::string(action.key()), "it is no key, and no list of keys");
    if (action.is(json::Kind::kString)) keys.emplace_back(action.text());
    for (const json::Value& key : action.children()) {
      if (!key.is(json::Kind::kString)) return core::fail(std::string(action.key()), "a key is a string");
      keys.emplace_back(key.text());
    }
    const auto bound = map.bind(action.key(), keys);
    if (!bound) return tl::unexpected(bound.error());
  }
  const auto complete = map.is_complete();
  if (!complete) return tl::unexpected(complete.error());
  return map;
}

std::string with_name(std::string text, const std::string& name) {
  if (text.empty()) text = "{}\n";
  const std::size_t open = text.find('{');
  assert(open != std::string::npos);
  const std::size_t next = text.find_first_not_of(" \t\r\n", open + 1);
  const bool is_empty = next == std::string::npos || text[next] == '}';
  std::string member = "\"name\": ";
  json::append_string(member, name);
  return text.insert(open + 1, member + (is_empty ? "" : ", "));
}

core::Expected<void> remember_name(const std::filesystem::path& file, const std::string& name) {
  std::error_code error;
  if (file.empty()) return core::fail("HOME", "is no path from / on");
  const std::filesystem::path there = std::filesystem::weakly_canonical(file, error);  // a link stays one
  if (error) return core::fail(file.string(), error.message());
  const std::string where = there.string();
  std::string text;
  if (std::filesystem::exists(there, error)) {
    auto read = core::read_whole_file(there, kMaxBytes);
    if (!read) return tl::unexpected(read.error());
    text = std::move(*read);
    // It may be another one by now than when the program started.
    const auto document = json::parse(text, {});
    if (!text.empty() && (!document || !document->root().is(json::Kind::kObject)))
      return core::fail(where, "is no JSON object");
    if (document && document->root().find("name")) return {};  // another client was asked, too, and answered
  }
  std::filesystem::create_directories(there.parent_path(), error);
  if (error) return core::fail(where, error.message());
  return core::replace_whole_file(there, with_name(std::move(text), name));
}

}  // namespace woodlouse::client
