// The options of the port on which the client speaks first.
#pragma once

#include <optional>
#include <string>

#include "server/net/listen_address.h"
#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::server {

/// As typed, before they are checked.
struct TypedWeb {
  std::optional<std::string> listen;
};

void add_web_options(CLI::App& app, TypedWeb& typed);

/// Nothing: there is no such port. Errors: where = the option.
core::Expected<std::optional<ListenAddress>> checked_web(const TypedWeb& typed);

}  // namespace woodlouse::server
