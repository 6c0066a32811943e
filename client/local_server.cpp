#include "client/local_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

namespace woodlouse::client {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kStartTimeout = 5s;
constexpr auto kStopTimeout = 1s;
constexpr std::string_view kListening = "listening ", kWeb = "web ";
constexpr const char* kUsualWeb = "127.0.0.1:7778";
constexpr const char* kAnyWeb = "127.0.0.1:0";
constexpr std::size_t kLastWords = 400;  // bytes of its standard error shown when it fails

std::filesystem::path own_folder() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path(".") : self.parent_path();
}

/// What follows `word` on the whole line that begins with it.
std::optional<std::string_view> line_behind(std::string_view text, std::string_view word) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    if (text.starts_with(word)) return text.substr(word.size(), end - word.size());
    text.remove_prefix(end + 1);
  }
  return std::nullopt;
}

struct Pipe {
  int read = -1;
  int write = -1;
};

core::Expected<Pipe> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return core::fail("local server", std::strerror(errno));
  return Pipe{ends[0], ends[1]};
}

/// In the child, between fork and exec: only async-signal-safe calls. Never returns.
[[noreturn]] void become(const char* const* arguments, pid_t parent, int output, int log) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // it died before the line above
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  // It stays in our process group: Ctrl-Z at the terminal stops the game with its player.
  execv(arguments[0], const_cast<char* const*>(arguments));
  _exit(127);
}

}  // namespace

/// Another server has the usual port already, or one that was started at this moment.
core::Expected<std::unique_ptr<LocalServer>> LocalServer::start(const LocalServerSettings& settings) {
  auto started = start(settings, kUsualWeb);
  const bool is_taken = !started && started.error().text().find(kUsualWeb) != std::string::npos;
  return is_taken ? start(settings, kAnyWeb) : std::move(started);
}

core::Expected<std::unique_ptr<LocalServer>> LocalServer::start(const LocalServerSettings& settings,
                                                                const char* web) {
  const std::string program = (own_folder() / "woodlouse-server").string();
  if (access(program.c_str(), X_OK) != 0) {
    return core::fail("local server", program + ": " + std::strerror(errno),
                      "build woodlouse-server, or name one that runs: woodlouse HOST:PORT");
  }
  const auto output = make_pipe();
  if (!output) return tl::unexpected(output.error());
  const auto log = make_pipe();
  if (!log) return tl::unexpected(log.error());
  fcntl(log->read, F_SETFL, O_NONBLOCK);
  fcntl(log->write, F_SETFL,
        O_NONBLOCK);  // nobody reads it while all is well: a full pipe drops, never blocks

  const std::string map = settings.map.string();
  const std::string bots = std::to_string(settings.bots);
  const std::array arguments = {
      program.c_str(), "--map", map.c_str(), "--listen",   "127.0.0.1:0",
      "--web",         web,     "--bots",    bots.c_str(), static_cast<const char*>(nullptr)};
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) become(arguments.data(), parent, output->write, log->write);
  close(output->write);
  close(log->write);
  std::unique_ptr<LocalServer> server(new LocalServer(child > 0 ? child : 0, output->read, log->read));
  if (child < 0) return core::fail("local server", std::strerror(errno));
  if (auto listening = server->wait_until_listening(); !listening) return tl::unexpected(listening.error());
  return server;
}

core::Expected<void> LocalServer::wait_until_listening() {
  std::string said;
  const auto deadline = Clock::now() + kStartTimeout;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wait{output_, POLLIN, 0};
    if (left <= 0 || poll(&wait, 1, static_cast<int>(left)) == 0) {
      return core::fail("local server", "it did not begin to listen within 5 s", last_words());
    }
    std::array<char, 512> bytes{};
    const ssize_t size = read(output_, bytes.data(), bytes.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return core::fail("local server", "it ended before it listened", last_words());
    said.append(bytes.data(), static_cast<std::size_t>(size));
    const auto listening = line_behind(said, kListening);
    const auto web = line_behind(said, kWeb);
    if (!listening || !web) continue;
    auto address = parse_address(*listening);
    if (!address) return tl::unexpected(address.error());
    address_ = *address;
    page_ = *web;
    return {};
  }
}

bool LocalServer::alive() {
  if (process_ != 0 && waitpid(process_, nullptr, WNOHANG) == process_) process_ = 0;
  std::array<char, 4096> bytes{};
  for (ssize_t size; (size = read(log_, bytes.data(), bytes.size())) > 0;) {
    words_.append(bytes.data(), static_cast<std::size_t>(size));
    if (words_.size() > kLastWords) words_.erase(0, words_.size() - kLastWords);
  }
  return process_ != 0;
}

std::string LocalServer::last_words() {
  // It may be about to write them: give it a moment to end.
  for (int i = 0; i < 20 && alive(); ++i) std::this_thread::sleep_for(10ms);
  while (!words_.empty() && words_.back() == '\n') words_.pop_back();
  return words_.empty() ? "it said nothing" : words_;
}

LocalServer::~LocalServer() {
  if (alive()) kill(process_, SIGTERM);
  const auto deadline = Clock::now() + kStopTimeout;
  while (alive() && Clock::now() < deadline) std::this_thread::sleep_for(5ms);
  if (alive()) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  close(output_);
  close(log_);
}

}  // namespace woodlouse::client
