#include "server/net/http_response.h"

#include <boost/beast/http/field.hpp>

#include <cassert>

namespace woodlouse::server {
namespace {

namespace http = boost::beast::http;

/// A page runs what it brings along, the core among it, and talks to this server alone.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

boost::beast::string_view beast_text(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace

HttpResponse make_response(const WebAnswer& answer, bool may_ask_again) {
  assert(answer.status >= 200 && (answer.status != 304 || answer.content().empty()));
  HttpResponse response;
  response.version(11);
  response.result(answer.status);
  response.set(http::field::server, "woodlouse");
  response.set(http::field::content_type, beast_text(answer.type));
  response.set(http::field::cache_control, beast_text(answer.cache));
  if (!answer.etag.empty()) response.set(http::field::etag, answer.etag);
  if (answer.is_packed) response.set(http::field::content_encoding, "gzip");
  if (answer.varies) response.set(http::field::vary, "Accept-Encoding");
  response.set("Content-Security-Policy", kPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  if (answer.status == 405) response.set(http::field::allow, "GET, HEAD");
  if (answer.status == 426) response.set(http::field::upgrade, "websocket");
  if (answer.status == 429 || answer.status == 503) response.set(http::field::retry_after, "1");
  response.keep_alive(may_ask_again);
  const std::string_view content = answer.content();
  response.body() = {content.data(), content.size()};
  if (answer.status != 304) response.content_length(content.size());
  return response;
}

}  // namespace woodlouse::server
