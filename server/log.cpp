#include "server/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <utility>

#include "shared/core/printable.h"
#include "shared/core/utf8.h"
#include "shared/json/text.h"

namespace woodlouse::server {
namespace {

/// %* in a pattern: the message as `text_of` shows it.
template <std::string (*text_of)(std::string_view)>
class ShownMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = text_of({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return spdlog::details::make_unique<ShownMessage>();
  }
};

template <std::string (*text_of)(std::string_view)>
std::unique_ptr<spdlog::formatter> formatter(const char* pattern, spdlog::pattern_time_type time) {
  auto result = std::make_unique<spdlog::pattern_formatter>(time);
  result->add_flag<ShownMessage<text_of>>('*').set_pattern(pattern);
  return result;
}

}  // namespace

std::string json_escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const core::Utf8Character character = core::first_character(text);
    if (!character.valid)
      out += '?';
    else if (character.code == '"' || character.code == '\\')
      out += {'\\', text.front()};
    else if (!core::is_printable(character.code))
      json::append_code(out, character.code);
    else
      out += text.substr(0, character.size);
    text.remove_prefix(character.size);
  }
  return out;
}

std::unique_ptr<spdlog::formatter> formatter_of(LogFormat format) {
  if (format == LogFormat::kText)
    return formatter<core::printable>("%H:%M:%S.%e %l %*", spdlog::pattern_time_type::local);
  return formatter<json_escaped>(R"({"time":"%Y-%m-%dT%H:%M:%S.%fZ","level":"%l","message":"%*"})",
                                 spdlog::pattern_time_type::utc);
}

std::shared_ptr<spdlog::logger> make_logger(LogFormat format) {
  auto log =
      std::make_shared<spdlog::logger>("woodlouse-server", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  log->set_formatter(formatter_of(format));
  log->flush_on(spdlog::level::info);
  return log;
}

}  // namespace woodlouse::server
