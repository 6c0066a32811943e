// An answer's head, as HTTP has it, with what browsers are told of all that comes from here.
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/span_body.hpp>

#include "server/web/web_answers.h"

namespace woodlouse::server {

using HttpResponse = boost::beast::http::response<boost::beast::http::span_body<const char>>;

/// `answer` has its bytes, and must outlive it.
[[nodiscard]] HttpResponse make_response(const WebAnswer& answer, bool may_ask_again);

}  // namespace woodlouse::server
