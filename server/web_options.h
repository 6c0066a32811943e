// The options of the port on which the client speaks first.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/net/web_names.h"
#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::server {

/// As typed, before they are checked.
struct TypedWeb {
  std::optional<std::string> listen;
  std::vector<std::string> hosts, origins;
  std::optional<std::filesystem::path> certificate, key, root;
};

void add_web_options(CLI::App& app, TypedWeb& typed);

/// Nothing: there is no such port. Errors: where = the option.
core::Expected<std::optional<WebSettings>> checked_web(const TypedWeb& typed);

}  // namespace woodlouse::server
