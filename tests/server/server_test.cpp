// The whole server in one process, where a test can make a part of it hang.
#include "server/server.h"

#include <spdlog/sinks/sink.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <condition_variable>
#include <csignal>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

using namespace woodlouse;
using namespace woodlouse::server;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

namespace asio = boost::asio;

/// A log that holds who says `hold` until `release` is said or `patience` is over.
class HoldingLog final : public spdlog::sinks::sink {
 public:
  static constexpr Duration kPatience = seconds(20);

  HoldingLog(std::string hold, std::string release) : hold_(std::move(hold)), release_(std::move(release)) {}

  void log(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.data(), message.payload.size());
    std::unique_lock lock(mutex_);
    said_.push_back(text);
    changed_.notify_all();
    if (text.find(hold_) == std::string::npos) return;
    changed_.wait_for(lock, kPatience, [this] { return said(release_); });
  }
  void flush() override {}
  void set_pattern(const std::string&) override {}
  void set_formatter(std::unique_ptr<spdlog::formatter>) override {}

  bool wait_for(std::string_view text) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return said(text); });
  }
  [[nodiscard]] bool has_said(std::string_view text) const {
    const std::lock_guard lock(mutex_);
    return said(text);
  }

 private:
  [[nodiscard]] bool said(std::string_view text) const {
    for (const std::string& line : said_)
      if (line.find(text) != std::string::npos) return true;
    return false;
  }

  std::string hold_, release_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> said_;
};

/// A client that joins; it stays until it is gone.
class Visitor {
 public:
  explicit Visitor(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    const auto port = static_cast<std::uint16_t>(std::stoul(address.substr(colon + 1)));
    socket_.connect({asio::ip::make_address(address.substr(0, colon)), port});
    asio::write(socket_, asio::buffer(std::string("{\"type\":\"join\",\"protocol\":1,\"name\":\"ann\"}\n")));
  }

 private:
  asio::io_context io_;
  asio::ip::tcp::socket socket_{io_};
};

}  // namespace

TEST_CASE("a lane that hangs does not hold up the end: it is told, and the server stops without it") {
  const auto log = std::make_shared<HoldingLog>("joined room", "did not stop within 800 ms");
  ServeConfig config;
  config.maps = {WOODLOUSE_SOURCE_DIR "/maps/volcano.json"};
  config.listen = {"127.0.0.1", 0};
  auto server = Server::create(config, {[&config] { return config; }, [] {}, [] { return std::uint64_t{0}; }},
                               std::make_shared<spdlog::logger>("test", log));
  REQUIRE(server);
  std::jthread runs([&] { (*server)->run(); });
  const Visitor visitor((*server)->address());
  const bool hangs = log->wait_for("joined room");  // its lane, in the middle of the welcome
  std::raise(SIGTERM);
  runs.join();
  CHECK(hangs);
  CHECK(log->has_said("SIGTERM: stopping"));
  CHECK(log->has_said("1 of rooms and port did not stop within 800 ms"));
}
