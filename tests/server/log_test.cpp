#include "server/log.h"

#include <spdlog/details/log_msg.h>
#include <spdlog/formatter.h>
#include <catch2/catch.hpp>

#include <string>

using woodlouse::server::formatter_of;
using woodlouse::server::json_escaped;
using woodlouse::server::LogFormat;

TEST_CASE("a logged text cannot leave its JSON string") {
  CHECK(json_escaped("plain, wörds 😀") == "plain, wörds 😀");
  CHECK(json_escaped("say \"hi\" \\ bye") == R"(say \"hi\" \\ bye)");
  CHECK(json_escaped("a\nb\x1b[2J") == R"(a\u000ab\u001b[2J)");
}

TEST_CASE("bytes that are no UTF-8 are logged as question marks") {
  CHECK(json_escaped("\xff\xfe") == "??");
  CHECK(json_escaped("a\xc3") == "a?");
  CHECK(json_escaped("\xc0\xaf") == "??");       // overlong
  CHECK(json_escaped("\xed\xa0\x80") == "???");  // a surrogate
  CHECK(json_escaped("\xe2\x82 x") == "?? x");
}

TEST_CASE("neither log shows a terminal anything but one line of text") {
  const auto line_of = [](LogFormat format, std::string_view message) {
    spdlog::memory_buf_t line;
    formatter_of(format)->format({"woodlouse-server", spdlog::level::info, {message.data(), message.size()}},
                                 line);
    return std::string(line.data(), line.size());
  };
  const std::string_view evil = "map a\x1b[2J\n\x7f\xc2\x9b\xe2\x80\xae!";
  const std::string text = line_of(LogFormat::kText, evil);
  CHECK(
      text.ends_with(" info map a?[2J???"
                     "?!\n"));
  CHECK(line_of(LogFormat::kJson, evil)
            .ends_with(R"("message":"map a\u001b[2J\u000a\u007f\u009b\u202e!"})"
                       "\n"));
}
