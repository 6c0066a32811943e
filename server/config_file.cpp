#include "server/config_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "shared/core/whole_file.h"

namespace woodlouse::server {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxConfigBytes = 1u << 20;
constexpr int kMaxDepth = 8;

core::Expected<std::string> as_typed(const Json& value, const std::string& where) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  return core::fail(
      where, "must be text, a number, true or false, or a list of them, not " + value.dump().substr(0, 40));
}

}  // namespace

core::Expected<std::vector<FileOption>> read_config_file(const std::filesystem::path& file) {
  const auto bytes = core::read_whole_file(file, kMaxConfigBytes);
  if (!bytes) return core::fail("--config " + bytes.error().where, bytes.error().what, bytes.error().hint);
  Json document;
  bool is_too_deep = false;
  try {
    // What is deeper is left out: copying and printing it would take the stack.
    document = Json::parse(*bytes, [&](int depth, Json::parse_event_t, Json&) {
      is_too_deep = is_too_deep || depth > kMaxDepth;
      return depth <= kMaxDepth;
    });
  } catch (const Json::parse_error& error) {
    return core::fail("--config " + file.string(), error.what());
  }
  if (is_too_deep)
    return core::fail("--config " + file.string(), "is nested too deep",
                      "an option is text, a number or a list of them");
  if (!document.is_object())
    return core::fail("--config " + file.string(), "is not a JSON object", R"(for example {"bots": 3})");
  std::vector<FileOption> options;
  for (const auto& [key, value] : document.items()) {
    FileOption option{key, {}};
    std::replace(option.first.begin(), option.first.end(), '_', '-');
    const std::string where = file.string() + ": " + key;
    const Json list = value.is_array() ? value : Json::array({value});
    for (const Json& element : list) {
      auto text = as_typed(element, where);
      if (!text) return tl::unexpected(text.error());
      option.second.push_back(std::move(*text));
    }
    options.push_back(std::move(option));
  }
  return options;
}

}  // namespace woodlouse::server
