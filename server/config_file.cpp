#include "server/config_file.h"

#include <algorithm>

#include "shared/core/joined.h"
#include "shared/core/whole_file.h"
#include "shared/json/document.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kMaxConfigBytes = 1u << 20;
constexpr json::Limits kLimits{3,
                               100'000};  // the options, an option's list; and one to say that it is too deep

core::Expected<std::string> as_typed(const json::Value& value, const std::string& where) {
  if (value.is(json::Kind::kString)) return std::string(value.text());
  if (value.is_number() || value.is(json::Kind::kBoolean)) return std::string(value.raw());
  return core::fail(where, core::joined({"must be text, a number, true or false, or a list of them, not ",
                                         json::to_text(value.kind())}));
}

}  // namespace

core::Expected<std::vector<FileOption>> read_config_file(const std::filesystem::path& file) {
  const auto bytes = core::read_whole_file(file, kMaxConfigBytes);
  if (!bytes) return core::fail("--config " + bytes.error().where, bytes.error().what, bytes.error().hint);
  const std::string name = "--config " + file.string();
  const auto document = json::parse_file(*bytes, name, kLimits);
  if (!document) return tl::unexpected(document.error());
  const json::Value root = document->root();
  if (!root.is(json::Kind::kObject))
    return core::fail(name, "is not a JSON object", R"(for example {"bots": 3})");
  std::vector<FileOption> options;
  for (const json::Value& value : root.children()) {
    FileOption option{std::string(value.key()), {}};
    std::replace(option.first.begin(), option.first.end(), '_', '-');
    const std::string where = file.string() + ": " + std::string(value.key());
    const auto same = [&option](const FileOption& other) { return other.first == option.first; };
    if (std::any_of(options.begin(), options.end(), same))
      return core::fail(where, "stands twice: - and _ are the same in a name");
    const bool is_list = value.is(json::Kind::kArray);
    for (const json::Value& element : is_list ? value.children() : std::vector{value}) {
      auto text = as_typed(element, where);
      if (!text) return tl::unexpected(text.error());
      option.second.push_back(std::move(*text));
    }
    options.push_back(std::move(option));
  }
  return options;
}

}  // namespace woodlouse::server
