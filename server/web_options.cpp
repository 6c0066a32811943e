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
  app.add_option(
         "--web-root", typed.root,
         "A folder with the page's files, read anew for each request, for who works on the page; left out: "
         "those that were built in")
      ->envname("WOODLOUSE_WEB_ROOT");
  app.add_option("--tls-cert", typed.certificate,
                 "PEM file of a certificate and those that vouch for it: TLS is spoken on --web, too; SIGHUP "
                 "reads it again")
      ->envname("WOODLOUSE_TLS_CERT");
  app.add_option("--tls-key", typed.key, "PEM file of its key, without a password")
      ->envname("WOODLOUSE_TLS_KEY");
}

core::Expected<std::optional<WebSettings>> checked_web(const TypedWeb& typed) {
  if (!typed.listen) {
    const char* useless = nullptr;
    if (typed.root) useless = "--web-root";
    if (typed.key) useless = "--tls-key";
    if (typed.certificate) useless = "--tls-cert";
    if (!typed.origins.empty()) useless = "--web-origin";
    if (!typed.hosts.empty()) useless = "--web-host";
    if (useless == nullptr) return std::nullopt;
    return core::fail(useless, "there is no port for browsers", "say where:  --web 127.0.0.1:7778");
  }
  if (typed.certificate.has_value() != typed.key.has_value())
    return core::fail(typed.key ? "--tls-key" : "--tls-cert", "a certificate and its key belong together",
                      "give both:  --tls-cert fullchain.pem --tls-key privkey.pem");
  auto address = parse_listen_address(*typed.listen, "--web", kDefaultWebPort);
  if (!address) return tl::unexpected(address.error());
  WebSettings settings{std::move(*address), {}, std::nullopt, std::nullopt};
  if (typed.certificate) settings.tls = TlsFiles{*typed.certificate, *typed.key};
  settings.root = typed.root;
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
