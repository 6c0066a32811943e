#include "server/admin/admin_request.h"

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/beast/http/verb.hpp>
#include <boost/system/error_code.hpp>

#include <cassert>

#include "shared/core/joined.h"

namespace woodlouse::server {

namespace http = boost::beast::http;

tl::expected<AdminRequest, WebAnswer> read_request(std::string_view head) {
  assert(head.size() <= kMostAdminHeadBytes);
  http::request_parser<http::empty_body> parser;
  parser.header_limit(static_cast<std::uint32_t>(kMostAdminHeadBytes));
  boost::system::error_code error;
  parser.put(boost::asio::buffer(head.data(), head.size()), error);
  if (error || !parser.is_header_done()) return tl::unexpected(refusal(400, "this is no HTTP/1"));
  const auto& request = parser.get();
  AdminRequest result;
  result.is_head = request.method() == http::verb::head;
  if (!result.is_head && request.method() != http::verb::get)
    return tl::unexpected(refusal(405, "GET and HEAD; commands are JSON lines, without HTTP"));
  if (request.count(http::field::content_length) + request.count(http::field::transfer_encoding) != 0)
    return tl::unexpected(refusal(413, "no request has a body here"));
  const std::string_view target(request.target().data(), request.target().size());
  result.path = target.substr(0, target.find('?'));
  const auto field = request[http::field::authorization];
  const std::string_view credentials(field.data(), field.size());
  constexpr std::string_view kBearer = "Bearer ";
  if (boost::beast::iequals(credentials.substr(0, kBearer.size()), kBearer))
    result.token = credentials.substr(kBearer.size());
  return result;
}

std::string response_text(const WebAnswer& answer, bool is_head) {
  assert(answer.status >= 200 && answer.status < 600);
  const auto reason = http::obsolete_reason(static_cast<http::status>(answer.status));
  std::string text = core::joined(
      {"HTTP/1.1 ",
       std::to_string(answer.status),
       " ",
       {reason.data(), reason.size()},
       "\r\nServer: woodlouse\r\nContent-Type: ",
       answer.type,
       "\r\nContent-Length: ",
       std::to_string(answer.body.size()),
       "\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n"});
  if (answer.status == 401) text += "WWW-Authenticate: Bearer\r\n";
  if (answer.status == 405) text += "Allow: GET, HEAD\r\n";
  text += "\r\n";
  if (!is_head) text += answer.body;
  return text;
}

}  // namespace woodlouse::server
