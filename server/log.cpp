#include "server/log.h"

#include <spdlog/async.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <future>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "server/logging/events.h"
#include "server/timing/clock.h"
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

/// %& in a pattern: the event that the message bears, between two texts; nothing where it bears none.
class ShownEvent final : public spdlog::custom_flag_formatter {
 public:
  ShownEvent(std::string before, std::string after) : before_(std::move(before)), after_(std::move(after)) {}
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string_view event = event_of(message);
    if (event.empty()) return;
    for (const std::string_view text : {std::string_view(before_), event, std::string_view(after_)})
      out.append(text.data(), text.data() + text.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return spdlog::details::make_unique<ShownEvent>(before_, after_);
  }

 private:
  const std::string before_, after_;
};

template <std::string (*text_of)(std::string_view)>
std::unique_ptr<spdlog::formatter> formatter(const char* pattern, spdlog::pattern_time_type time,
                                             const char* before, const char* after) {
  auto result = std::make_unique<spdlog::pattern_formatter>(time);
  result->template add_flag<ShownMessage<text_of>>('*');
  result->template add_flag<ShownEvent>('&', before, after);
  result->set_pattern(pattern);
  return result;
}

/// Standard error or a file, not by way of stdio: whose lock a thread that stands in a write would keep, and
/// exit() wants.
class DescriptorSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  DescriptorSink() = default;
  DescriptorSink(std::string file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {
    assert(descriptor_ >= 0);
  }
  ~DescriptorSink() override {
    if (!file_.empty()) ::close(descriptor_);
  }
  static int open(const std::string& file) {
    // A pipe that nobody reads is refused instead of waited for.
    const int opened = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (opened >= 0) ::fcntl(opened, F_SETFL, O_APPEND);
    return opened;
  }
  void reopen() { is_moved_ = true; }
  [[nodiscard]] std::uint64_t unwritten() const { return unwritten_; }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (!file_.empty() && is_moved_.exchange(false)) {
      const int next = open(file_);
      if (next >= 0) ::close(std::exchange(descriptor_, next));
    }
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    for (std::string_view left(line.data(), line.size()); !left.empty();) {
      const ssize_t count = ::write(descriptor_, left.data(), left.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) {  // whoever started the server has it so
        pollfd out{descriptor_, POLLOUT, 0};
        ::poll(&out, 1, -1);
        continue;
      }
      if (count < 0) {  // closed, or full: nobody is left to be told, but who asks for figures
        ++unwritten_;
        return;
      }
      left.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  void flush_() override {}

  const std::string file_;  ///< empty: standard error
  int descriptor_ = STDERR_FILENO;
  std::atomic<bool> is_moved_{false};
  std::atomic<std::uint64_t> unwritten_{0};
};

/// Hands on to another sink, and tells in a line of its own how many lines were lost before the next.
class CountingSink final : public spdlog::sinks::sink {
 public:
  /// thread: calls this one, and is ended by whoever owns it: were it held here, its last owner could be
  /// itself.
  CountingSink(spdlog::sink_ptr target, spdlog::details::thread_pool& thread)
      : sink_(std::move(target)), thread_(thread) {}

  void log(const spdlog::details::log_msg& message) override {
    const std::size_t lost = thread_.overrun_counter();
    if (lost != told_) {
      const std::string text = std::to_string(lost - told_) + " lines of the log are lost: nobody read it";
      sink_->log({message.time,
                  borne_by(LogEvent::kLogLinesLost),
                  message.logger_name,
                  entry_of(LogEvent::kLogLinesLost).level,
                  {text.data(), text.size()}});
      told_ = lost;
    }
    sink_->log(message);
  }
  void flush() override { sink_->flush(); }
  void set_pattern(const std::string& pattern) override { sink_->set_pattern(pattern); }
  void set_formatter(std::unique_ptr<spdlog::formatter> formatter) override {
    sink_->set_formatter(std::move(formatter));
  }

 private:
  spdlog::sink_ptr sink_;
  spdlog::details::thread_pool& thread_;
  std::size_t told_ = 0;
};

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
    return formatter<core::printable>("%H:%M:%S.%e %l %&%*", spdlog::pattern_time_type::local, "", ": ");
  return formatter<json_escaped>(R"({"time":"%Y-%m-%dT%H:%M:%S.%fZ","level":"%l",%&"message":"%*"})",
                                 spdlog::pattern_time_type::utc, R"("event":")", R"(",)");
}

Log::Log(LogFormat format) : Log(format, std::make_shared<DescriptorSink>()) {}

std::uint64_t Log::lost_lines() const {
  assert(thread_ != nullptr && sink_ != nullptr);
  const auto* own = dynamic_cast<const DescriptorSink*>(sink_.get());
  return thread_->overrun_counter() + (own == nullptr ? 0 : own->unwritten());
}

core::Expected<std::unique_ptr<Log>> Log::open(LogFormat format, const std::filesystem::path& file) {
  const int descriptor = DescriptorSink::open(file.string());
  if (descriptor < 0) return core::fail("--log-file " + file.string(), std::strerror(errno));
  const auto sink = std::make_shared<DescriptorSink>(file.string(), descriptor);
  auto log = std::make_unique<Log>(format, sink);
  log->reopen_ = [sink] { sink->reopen(); };
  return log;
}

Log::Log(LogFormat format, spdlog::sink_ptr sink)
    : sink_(std::move(sink)),
      thread_(std::make_shared<spdlog::details::thread_pool>(kMostWaiting, 1)),
      logger_(std::make_shared<spdlog::async_logger>("woodlouse-server",
                                                     std::make_shared<CountingSink>(sink_, *thread_), thread_,
                                                     spdlog::async_overflow_policy::overrun_oldest)) {
  logger_->set_formatter(formatter_of(format));
  logger_->flush_on(spdlog::level::info);
}

/// The thread ends when it has written all that waits. One that stands in a write is left behind, with all
/// that it holds.
Log::~Log() {
  logger_.reset();
  std::size_t waiting = thread_->queue_size();
  const auto latest = Clock::now() + kLongest;
  for (auto moved = Clock::now(); waiting > 0 && Clock::now() < std::min(latest, moved + kPatience);) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::size_t left = thread_->queue_size();
    if (std::exchange(waiting, left) > left) moved = Clock::now();
  }
  auto ended = std::make_shared<std::promise<void>>();
  const std::future<void> end = ended->get_future();
  try {
    std::thread([thread = std::move(thread_), ended]() mutable {
      thread.reset();
      ended->set_value();
    }).detach();
    end.wait_for(waiting > 0 ? Duration{} : Duration(kPatience));  // it has had that long
  } catch (const std::system_error&) {                             // no thread for it: what waits is lost
    assert(!logger_);
  }
}

}  // namespace woodlouse::server
