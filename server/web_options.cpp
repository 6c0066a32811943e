#include "server/web_options.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace woodlouse::server {

void add_web_options(CLI::App& app, TypedWeb& typed) {
  app.add_option("--web", typed.listen,
                 "HOST:PORT of a port on which the client speaks first, so that one serves for lines and for "
                 "browsers; printed as `web http://HOST:PORT/`. Left out: there is none")
      ->envname("WOODLOUSE_WEB");
}

core::Expected<std::optional<ListenAddress>> checked_web(const TypedWeb& typed) {
  if (!typed.listen) return std::nullopt;
  auto address = parse_listen_address(*typed.listen, "--web", kDefaultWebPort);
  if (!address) return tl::unexpected(address.error());
  return std::move(*address);
}

}  // namespace woodlouse::server
