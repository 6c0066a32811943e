#include "server/web/web_answers.h"

#include <cassert>
#include <optional>
#include <utility>

#include "shared/core/joined.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {
namespace {

using core::joined;

std::string rooms_table(const protocol::Rooms& list) {
  std::string rows;
  for (const protocol::RoomEntry& room : list.rooms)
    rows += joined({"<tr><td>", html_escaped(room.name), "<td>", html_escaped(room.map), "<td>",
                    std::to_string(room.players), "<td>", std::to_string(room.bots), "<td>",
                    std::to_string(room.spectators), "<td>", html_escaped(room.code), "<td>",
                    room.address.empty() ? "here" : html_escaped(room.address), "\n"});
  return joined({"<table>\n<tr><th>room<th>map<th>players<th>bots<th>spectators<th>code<th>where\n", rows,
                 "</table>\n"});
}

WebAnswer front_page(std::string_view host, const Directory& directory, const WebFacts& facts) {
  const std::string name = html_escaped(host);
  const bool is_v6 = name.find(':') != std::string::npos;
  const std::string port = std::to_string(facts.lines_port);
  const std::string where = joined({is_v6 ? "[" : "", name, is_v6 ? "]" : "", ":", port});
  WebAnswer answer{200, "text/html; charset=utf-8", {}};
  answer.body =
      joined({"<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Woodlouse</title>\n"
              "<h1>A woodlouse server</h1>\n<p>",
              html_escaped(facts.server_name),
              ": wood-lice on hills. You push one; the server steps all of them, the same for everybody.\n"
              "<h2>Rooms</h2>\n",
              rooms_table(directory.list()), "<h2>How to join</h2>\n<p>In a terminal:\n<pre>woodlouse ",
              where, "</pre>\n<p>By hand, a JSON object a line:\n<pre>nc ", name, " ", port,
              "\n{\"type\":\"join\",\"protocol\":1,\"name\":\"me\"}\n"
              "{\"type\":\"input\",\"seq\":1,\"thrust\":1,\"ticks\":30}</pre>\n"
              "<p>With a bot of yours, which begins as one of those in <code>bots/</code>:\n"
              "<pre>python3 bots/python/hill_climber.py ",
              where,
              "</pre>\n<p>From a page or a program that has WebSockets: <code>/ws</code> on this port, where "
              "a message of yours is a line.\n"
              "<p>For programs: <a href=\"/rooms\">/rooms</a>, <a href=\"/healthz\">/healthz</a>, <a "
              "href=\"/readyz\">/readyz</a>.\n</html>\n"});
  return answer;
}

/// The array of the message `rooms`.
WebAnswer rooms_array(const Directory& directory) {
  const std::string line = protocol::encode(directory.list());
  const std::size_t begin = line.find('[');
  const std::size_t end = line.rfind(']');
  assert(begin != std::string::npos && end != std::string::npos && begin < end);
  return {200, "application/json", line.substr(begin, end + 1 - begin) + '\n'};
}

std::optional<WebAnswer> page_file(const PageFiles& pages, std::string_view path,
                                   const WebQuestion& question) {
  auto file = pages.find(path, takes_gzip(question.accept_encoding));
  if (!file) return std::nullopt;
  WebAnswer answer;
  answer.type = file->type;
  answer.cache = file->is_for_good ? "public, max-age=31536000, immutable" : "no-cache";
  answer.etag = std::move(file->etag);
  answer.varies = file->varies;
  if (has_already(question.if_none_match, answer.etag)) {
    answer.status = 304;
    return answer;
  }
  answer.is_packed = file->is_packed;
  answer.fixed = file->bytes;
  answer.body = std::move(file->read);
  return answer;
}

}  // namespace

WebAnswer readiness(bool is_stopping, std::string_view why_not) {
  if (is_stopping) return refusal(503, "the server stops");
  return why_not.empty() ? refusal(200, "ready") : refusal(503, why_not);
}

WebAnswer answer_to(const WebQuestion& question, const Directory& directory, const WebFacts& facts,
                    Time now) {
  const std::string_view path = question.target.substr(0, question.target.find('?'));
  if (path == "/about") return front_page(question.host, directory, facts);
  if (path == "/rooms") return rooms_array(directory);
  if (path == "/healthz") return refusal(200, "ok");
  if (path == "/readyz") return readiness(facts.is_stopping, directory.why_not_ready(now));
  if (facts.pages != nullptr)
    if (auto file = page_file(*facts.pages, path, question)) return std::move(*file);
  if (path == "/") return front_page(question.host, directory, facts);
  return refusal(404, "there is no such page: / says what there is");
}

WebAnswer refusal(std::uint32_t status, std::string_view why) {
  assert(status >= 200 && status < 600 && !why.empty());
  WebAnswer answer;
  answer.status = status;
  answer.body = joined({why, "\n"});
  return answer;
}

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += c;
  }
  return result;
}

}  // namespace woodlouse::server
