#include "server/log.h"

#include <unistd.h>

#include <spdlog/details/log_msg.h>
#include <spdlog/formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <atomic>
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

using woodlouse::server::formatter_of;
using woodlouse::server::json_escaped;
using woodlouse::server::Log;
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

TEST_CASE("who logs never waits for who reads, and what was lost is counted") {
  class Stuck final : public spdlog::sinks::base_sink<std::mutex> {
   public:
    std::promise<void> stands, go_on;
    std::vector<std::string> lines;

   private:
    void sink_it_(const spdlog::details::log_msg& message) override {
      if (lines.empty()) {
        stands.set_value();
        go_on.get_future().wait();
      }
      lines.emplace_back(message.payload.data(), message.payload.size());
    }
    void flush_() override {}
  };
  const auto sink = std::make_shared<Stuck>();
  constexpr std::size_t kMore = 500;
  {
    const Log log(LogFormat::kText, sink);
    log.logger()->info("first");
    sink->stands.get_future().wait();
    for (std::size_t k = 0; k < Log::kMostWaiting + kMore; ++k)
      log.logger()->info("line " + std::to_string(k));
    CHECK(log.lost_lines() >= kMore - 1);
    sink->go_on.set_value();
  }
  REQUIRE(sink->lines.size() > Log::kMostWaiting);
  CHECK(sink->lines.back() == "line " + std::to_string(Log::kMostWaiting + kMore - 1));
  const auto told = std::find_if(sink->lines.begin(), sink->lines.end(), [](const std::string& line) {
    return line.find(" lines of the log are lost") != std::string::npos;
  });
  REQUIRE(told != sink->lines.end());
  const auto lost = static_cast<std::size_t>(std::stoul(*told));
  CHECK(lost >= kMore - 1);
  CHECK(lost + sink->lines.size() == Log::kMostWaiting + kMore + 2);  // the first, and the word of the lost
}

TEST_CASE("a line that can't be written is one that is lost") {
  const auto log = Log::open(LogFormat::kText, "/dev/full");
  REQUIRE(log);
  for (int k = 0; k < 3; ++k) (*log)->logger()->info("nowhere to go");
  for (int k = 0; k < 2000 && (*log)->lost_lines() < 3; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK((*log)->lost_lines() == 3);
}

TEST_CASE("a log that nobody reads keeps no server from ending") {
  class Never final : public spdlog::sinks::base_sink<std::mutex> {
    void sink_it_(const spdlog::details::log_msg&) override {
      for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    void flush_() override {}
  };
  const auto begin = std::chrono::steady_clock::now();
  {
    const Log log(LogFormat::kText, std::make_shared<Never>());
    for (std::size_t k = 0; k < 2 * Log::kMostWaiting; ++k) log.logger()->info("line");
  }
  CHECK(std::chrono::steady_clock::now() - begin < 100 * Log::kPatience);
}

TEST_CASE("a log that ends while its last line is being written writes it") {
  struct Slow final : spdlog::sinks::base_sink<std::mutex> {
    void sink_it_(const spdlog::details::log_msg&) override {
      std::this_thread::sleep_for(Log::kPatience / 2);
      ++written;
    }
    void flush_() override {}
    std::atomic<int> written{0};
  };
  const auto slow = std::make_shared<Slow>();
  {
    const Log log(LogFormat::kText, slow);
    log.logger()->info("line");
    std::this_thread::sleep_for(Log::kPatience /
                                10);  // it is taken from the queue, in which nothing waits any more
  }
  CHECK(slow->written == 1);
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

TEST_CASE("a log in a file goes on in a new one when the old is moved away and it is told so") {
  const auto folder =
      std::filesystem::temp_directory_path() / ("woodlouse_log_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const auto file = folder / "server.log", moved = folder / "server.log.1";
  const auto text_of = [](const std::filesystem::path& path) {
    std::ifstream in(path);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  {
    auto log = Log::open(LogFormat::kText, file);
    REQUIRE(log);
    (*log)->logger()->info("one");
    for (int k = 0; k < 2000 && text_of(file).empty(); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::filesystem::rename(file, moved);
    (*log)->logger()->info("two");
    for (int k = 0; k < 2000 && text_of(moved).find("two") == std::string::npos; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    (*log)->reopen();
    (*log)->logger()->info("three");
  }
  CHECK(text_of(moved).find("two\n") != std::string::npos);
  CHECK(text_of(moved).find("three") == std::string::npos);
  CHECK(text_of(file).find("three\n") != std::string::npos);
  std::filesystem::remove_all(folder);
  CHECK_FALSE(Log::open(LogFormat::kText, folder / "nowhere" / "server.log"));
}
