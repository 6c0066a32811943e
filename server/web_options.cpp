#include "server/web_options.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace woodlouse::server {

void add_web_options(CLI::App& app, TypedWeb& typed) {
  app.add_option(
         "--web", typed.listen,
         "HOST:PORT of a port on which the client speaks first: HTTP, WebSockets, or lines; printed as "
         "`web http://HOST:PORT/`. Left out: there is none")
      ->envname("WOODLOUSE_WEB");
  app.add_option("--web-host", typed.hosts,
                 "A name by which browsers may ask, besides addresses and localhost; several may be given")
      ->envname("WOODLOUSE_WEB_HOST");
  app.add_option(
         "--web-origin", typed.origins,
         "A page's scheme://host:port that may open WebSockets, besides this server's own; several may "
         "be given")
      ->envname("WOODLOUSE_WEB_ORIGIN");
}

core::Expected<std::optional<WebSettings>> checked_web(const TypedWeb& typed) {
  if (!typed.listen) {
    if (typed.hosts.empty() && typed.origins.empty()) return std::nullopt;
    return core::fail(typed.hosts.empty() ? "--web-origin" : "--web-host", "there is no port for browsers",
                      "say where:  --web 127.0.0.1:7778");
  }
  auto address = parse_listen_address(*typed.listen, "--web", kDefaultWebPort);
  if (!address) return tl::unexpected(address.error());
  WebSettings settings{std::move(*address), {}};
  for (const std::string& text : typed.hosts) {
    auto host = checked_web_host(text);
    if (!host) return tl::unexpected(host.error());
    settings.names.hosts.push_back(std::move(*host));
  }
  for (const std::string& text : typed.origins) {
    auto origin = checked_web_origin(text);
    if (!origin) return tl::unexpected(origin.error());
    settings.names.origins.push_back(std::move(*origin));
  }
  return settings;
}

}  // namespace woodlouse::server
