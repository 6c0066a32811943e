#include "server/logging/events.h"

#include <catch2/catch.hpp>

#include <spdlog/formatter.h>
#include <spdlog/sinks/ostream_sink.h>

#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "server/log.h"

namespace woodlouse::server::logging_test {
namespace {

/// What the log would be when that is logged.
std::string logged(LogFormat format, spdlog::level::level_enum level, LogEvent event,
                   const std::string& text) {
  std::ostringstream out;
  spdlog::logger logger("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(out));
  logger.set_formatter(formatter_of(format));
  logger.set_level(level);
  log_event(logger, event, text);
  CHECK(is_logged(logger, event) == !out.str().empty());
  return out.str();
}

std::string level_text(spdlog::level::level_enum level) {
  const auto text = spdlog::level::to_string_view(level);
  return {text.data(), text.size()};
}

}  // namespace

TEST_CASE("the table of events in docs/metrics.md is the one in the code") {
  std::ifstream file(WOODLOUSE_SOURCE_DIR "/docs/metrics.md");
  REQUIRE(file);
  std::vector<std::string> rows;
  bool is_below = false;
  for (std::string line; std::getline(file, line);) {
    is_below |= line == "## Events of the log";
    if (is_below && line.starts_with("| `")) rows.push_back(line);
  }
  REQUIRE(rows.size() == log_events().size());
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const LogEventEntry& entry = log_events()[k];
    CHECK(rows[k] == "| `" + std::string(entry.name) + "` | " + level_text(entry.level) + " | " +
                         std::string(entry.meaning) + " |");
    CHECK(names.insert(entry.name).second);
  }
}

TEST_CASE("an event's name stands before its text, and is a member of its own where the log is JSON") {
  const auto text = logged(LogFormat::kText, spdlog::level::info, LogEvent::kRoomAwake, "room r: goes on");
  CHECK(text.ends_with(" info room_awake: room r: goes on\n"));
  const auto json = logged(LogFormat::kJson, spdlog::level::info, LogEvent::kRoomAwake, "room r: goes on");
  CHECK(json.ends_with(R"("level":"info","event":"room_awake","message":"room r: goes on"})"
                       "\n"));
}

TEST_CASE("no text makes itself another event") {
  const std::string evil = "x\",\"event\":\"left\n12:00:00.000 info left: session";
  const auto text = logged(LogFormat::kText, spdlog::level::info, LogEvent::kJoined, evil);
  CHECK(text.find(" info joined: x") == 12);
  CHECK(text.find('\n') == text.size() - 1);
  const auto json = logged(LogFormat::kJson, spdlog::level::info, LogEvent::kJoined, evil);
  CHECK(json.find(R"("event":"joined","message":"x\",\"event\":\"left\u000a)") != std::string::npos);
}

TEST_CASE("an event is logged at its own level") {
  CHECK(logged(LogFormat::kText, spdlog::level::warn, LogEvent::kJoined, "x").empty());
  CHECK(logged(LogFormat::kText, spdlog::level::info, LogEvent::kConnected, "x").empty());
  CHECK(logged(LogFormat::kText, spdlog::level::err, LogEvent::kShadowDiffers, "x")
            .ends_with(" error shadow_differs: x\n"));
}

}  // namespace woodlouse::server::logging_test
