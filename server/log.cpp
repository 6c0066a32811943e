#include "server/log.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <utility>

#include "shared/json/utf8.h"

namespace woodlouse::server {
namespace {

/// %* in a pattern: the message as the inside of a JSON string.
class EscapedMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = json_escaped({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return spdlog::details::make_unique<EscapedMessage>();
  }
};

}  // namespace

std::string json_escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const json::Utf8Character character = json::first_character(text);
    if (!character.valid)
      out += '?';
    else if (character.code == '"' || character.code == '\\')
      out += {'\\', text.front()};
    else if (character.code < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(character.code));
    else
      out += text.substr(0, character.size);
    text.remove_prefix(character.size);
  }
  return out;
}

std::shared_ptr<spdlog::logger> make_logger(LogFormat format) {
  auto log =
      std::make_shared<spdlog::logger>("woodlouse-server", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  if (format == LogFormat::kText) {
    log->set_pattern("%H:%M:%S.%e %l %v");
  } else {
    auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
    formatter->add_flag<EscapedMessage>('*').set_pattern(
        R"({"time":"%Y-%m-%dT%H:%M:%S.%fZ","level":"%l","message":"%*"})");
    log->set_formatter(std::move(formatter));
  }
  log->flush_on(spdlog::level::info);
  return log;
}

}  // namespace woodlouse::server
