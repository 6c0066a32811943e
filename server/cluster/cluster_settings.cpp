#include "server/cluster/cluster_settings.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/whole_file.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kMostFileBytes = 64u << 10;
constexpr std::size_t kMostServers = 16;
constexpr std::size_t kMostTextBytes = 1024;
constexpr json::Limits kLimits{4, 256};

void read_milliseconds(const json::Fields& fields, std::string_view key, std::uint64_t least,
                       std::uint64_t most, Duration& into, json::Problems& problems) {
  const auto value = fields.find(key);
  if (!value) return;
  if (const auto number = json::integer_in(*value, least, most, problems))
    into = std::chrono::milliseconds(static_cast<std::int64_t>(*number));
}

void read_name(const json::Fields& fields, std::string_view key, std::string& into,
               json::Problems& problems) {
  const auto value = fields.find(key);
  if (!value) return;
  const auto text = json::text_in(*value, 1, 32, problems);
  if (!text) return;
  if (!is_cluster_name(*text)) return problems.add(*value, "is to be of letters, digits, - and _");
  into = *text;
}

void read_file_name(const json::Fields& fields, std::string_view key, std::filesystem::path& into,
                    json::Problems& problems) {
  if (const auto value = fields.find(key))
    if (auto text = json::text_in(*value, 1, kMostTextBytes, problems)) into = std::move(*text);
}

void read_servers(const json::Fields& fields, std::vector<std::string>& into, json::Problems& problems) {
  const auto list = fields.demand("nats", R"(as "nats": ["nats://127.0.0.1:4222"])");
  if (!list) return;
  if (!list->is(json::Kind::kArray) || list->size() == 0 || list->size() > kMostServers)
    return problems.add(*list, "is to be a list of 1 to 16 servers", R"(as ["nats://127.0.0.1:4222"])");
  list->for_each([&](const json::Value& value) {
    if (auto text = json::text_in(value, 1, kMostTextBytes, problems)) {
      if (text->starts_with("nats://") || text->starts_with("tls://"))
        into.push_back(std::move(*text));
      else
        problems.add(value, "is to begin with nats:// or tls://");
    }
    return true;
  });
}

}  // namespace

bool is_cluster_name(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

core::Expected<ClusterSettings> read_cluster_settings(const std::filesystem::path& file) {
  const auto text = core::read_whole_file(file, kMostFileBytes);
  if (!text) return tl::unexpected(text.error());
  const auto document = json::parse_file(*text, file.string(), kLimits, 1);
  if (!document) return tl::unexpected(document.error());
  json::Problems problems(file.string());
  const json::Value root = document->root();
  if (!root.is(json::Kind::kObject))
    return core::fail(file.string(), "is no object", R"(as {"nats": ["nats://127.0.0.1:4222"]})");
  const json::Fields fields(
      root,
      {"name", "nats", "shard", "replicas", "mode", "batch_ms", "silence_ms", "keep_s", "tls", "credentials"},
      problems);
  ClusterSettings settings;
  read_name(fields, "name", settings.cluster, problems);
  read_name(fields, "shard", settings.shard, problems);
  read_servers(fields, settings.nats, problems);
  if (const auto value = fields.find("replicas")) {
    settings.replicas = static_cast<std::uint32_t>(json::integer_in(*value, 1, 5, problems).value_or(1));
    if (settings.replicas % 2 == 0) problems.add(*value, "is to be 1, 3 or 5: a majority decides");
  }
  if (const auto value = fields.find("mode")) {
    const auto mode = json::text_in(*value, 1, kMostTextBytes, problems);
    settings.is_strict = mode == "strict";
    if (mode && *mode != "play" && *mode != "strict") problems.add(*value, "is to be play or strict");
  }
  read_milliseconds(fields, "batch_ms", 10, 1000, settings.batch, problems);
  read_milliseconds(fields, "silence_ms", 150, 60'000, settings.silence, problems);
  if (const auto value = fields.find("keep_s"))
    settings.keep = std::chrono::seconds(
        static_cast<std::int64_t>(json::integer_in(*value, 60, 7 * 86'400, problems).value_or(3600)));
  read_file_name(fields, "credentials", settings.credentials, problems);
  if (const auto tls = fields.find("tls")) {
    const json::Fields files(*tls, {"ca", "cert", "key"}, problems);
    read_file_name(files, "ca", settings.authority, problems);
    read_file_name(files, "cert", settings.certificate, problems);
    read_file_name(files, "key", settings.key, problems);
  }
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return settings;
}

}  // namespace woodlouse::server
