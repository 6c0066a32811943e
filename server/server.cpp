#include "server/server.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <csignal>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "server/recorder.h"
#include "shared/map/map_loader.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

/// game.ndjson, for one room of several: game.volcano.ndjson
fs::path recording_of(const fs::path& file, const std::string& room, std::size_t rooms) {
  if (rooms == 1) return file;
  std::string safe = room;
  std::replace_if(
      safe.begin(), safe.end(), [](char c) { return c == '/' || c == '\\' || c == '.' || c == ' '; }, '_');
  fs::path result = file;
  return result.replace_filename(file.stem().string() + '.' + safe + file.extension().string());
}

std::string unique_name(const std::string& name, std::set<std::string>& taken) {
  std::string result = name;
  for (int number = 2; !taken.insert(result).second; ++number) result = name + '-' + std::to_string(number);
  return result;
}

std::uint64_t entropy() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

}  // namespace

Server::Server(const ServeConfig& config, std::shared_ptr<spdlog::logger> log)
    : log_(std::move(log)),
      io_(static_cast<int>(kIoThreads)),
      strand_(asio::make_strand(io_)),
      signals_(strand_, SIGINT, SIGTERM),
      deadline_(strand_),
      environment_{lobby_, limits_, traffic_, log_},
      acceptor_(io_, environment_) {
  // A bot may push once a tick and still ask for the time.
  limits_.messages_per_s = std::max(limits_.messages_per_s, 2 * config.tick_hz);
  limits_.burst = std::max(limits_.burst, 2 * limits_.messages_per_s);
}

Server::~Server() = default;

core::Expected<std::unique_ptr<Server>> Server::create(const ServeConfig& config,
                                                       std::shared_ptr<spdlog::logger> log) {
  std::unique_ptr<Server> server(new Server(config, std::move(log)));
  // The port first: a busy one must not cost somebody his recording.
  const auto endpoint = server->acceptor_.open(config.listen);
  if (!endpoint) return tl::unexpected(endpoint.error());
  server->address_ = to_text(*endpoint);
  if (const auto opened = server->open_rooms(config); !opened) return tl::unexpected(opened.error());
  return server;
}

core::Expected<bool> Server::open_rooms(const ServeConfig& config) {
  const std::uint64_t seed = config.seed ? *config.seed : entropy();
  std::set<std::string> names;
  for (const fs::path& file : config.maps) {
    const auto map = map::load_map(file);
    if (!map) return tl::unexpected(map.error());
    RoomSettings settings;
    settings.name = unique_name((*map)->definition.name, names);
    settings.map_file = file.string();
    settings.tick_hz = config.tick_hz;
    settings.state_hz = config.state_hz;
    settings.seed = seed + rooms_.size();
    settings.bots = config.bots;
    settings.tick_limit = config.ticks;
    settings.per_room = limits_.per_room;
    std::unique_ptr<Recorder> recorder;
    if (config.record) {
      auto opened =
          Recorder::open(recording_of(*config.record, settings.name, config.maps.size()), disk_, log_);
      if (!opened) return tl::unexpected(opened.error());
      recorder = std::move(*opened);
    }
    log_->info("room {}: map {}, {} ticks/s, {} frames/s, seed {}", settings.name, file.string(),
               config.tick_hz, config.state_hz, settings.seed);
    rooms_.push_back(
        std::make_unique<Room>(ticks_, io_, std::move(settings), *map, std::move(recorder), log_));
    lobby_.add(*rooms_.back());
  }
  return true;
}

void Server::run() {
  auto ticks_work = asio::make_work_guard(ticks_);
  auto io_work = asio::make_work_guard(io_);
  await_signal();
  for (const auto& room : rooms_) room->start([this] { asio::post(strand_, [this] { room_ended(); }); });
  acceptor_.start();

  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < std::min(rooms_.size(), cores); ++i)
    threads.emplace_back([this] { ticks_.run(); });
  for (std::size_t i = 0; i < kIoThreads; ++i) threads.emplace_back([this] { io_.run(); });
  threads.clear();
  disk_.join();
}

void Server::await_signal() {
  signals_.async_wait([this](const boost::system::error_code& error, int signal) {
    if (error) return;
    const std::string name = signal == SIGINT ? "SIGINT" : "SIGTERM";
    log_->info("{}: stopping", name);
    stop("the server stops", name);
  });
}

void Server::room_ended() {
  if (++rooms_ended_ == rooms_.size()) stop("the game is over", "ticks done");
}

void Server::stop(const std::string& text, const std::string& reason) {
  if (std::exchange(stopping_, true)) return;
  const protocol::Bye bye{std::string(protocol::code::kShutdown), text, false};
  deadline_.expires_after(kStopWithin);
  deadline_.async_wait([this](const boost::system::error_code& error) {
    if (!error) give_up_waiting();
  });
  parts_running_ = rooms_.size() + 1;
  const auto part_done = [this] { asio::post(strand_, [this] { part_stopped(); }); };
  for (const auto& room : rooms_) room->stop(bye, reason, part_done);
  acceptor_.stop(bye, part_done);
}

void Server::part_stopped() {
  if (--parts_running_ > 0) return;
  deadline_.cancel();
  stop_contexts();
}

void Server::give_up_waiting() {
  log_->warn("{} of rooms and port did not stop within {} ms", parts_running_,
             std::chrono::duration_cast<std::chrono::milliseconds>(kStopWithin).count());
  stop_contexts();
}

void Server::stop_contexts() {
  ticks_.stop();
  io_.stop();
}

void Server::print_summary(std::ostream& out) const {
  for (const auto& room : rooms_) out << summary(room->name(), room->metrics()) << '\n';
  out << "frames sent " << traffic_.frames_sent << ", bytes sent " << traffic_.bytes_sent
      << ", lines received " << traffic_.lines_received << '\n';
}

}  // namespace woodlouse::server
