#include "server/server.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <variant>

#include "server/commands/fork.h"
#include "server/watchers/recorder.h"
#include "server/watchers/shadow.h"
#include "shared/core/stable_hash.h"
#include "shared/map/map_file.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

/// A room's name as a part of a file's.
std::string file_part(std::string room) {
  std::replace_if(
      room.begin(), room.end(), [](char c) { return c == '/' || c == '\\' || c == '.' || c == ' '; }, '_');
  return room;
}

/// game.ndjson, for one room of several: game.volcano.ndjson
fs::path recording_of(const fs::path& file, const std::string& room, std::size_t rooms) {
  if (rooms <= 1) return file;
  const std::string packed = file.extension() == ".zst" ? ".zst" : "";
  const fs::path plain = packed.empty() ? file : fs::path(file).replace_extension();
  return fs::path(file).replace_filename(plain.stem().string() + '.' + file_part(room) +
                                         plain.extension().string() + packed);
}

/// Beside the recording, or where the server was started.
fs::path dump_of_shadow(const ServeConfig& config, const std::string& room) {
  return config.record.value_or(fs::path()).replace_filename("shadow." + file_part(room));
}

std::size_t tick_threads(std::size_t rooms) {
  return std::min<std::size_t>(rooms, std::max(1u, std::thread::hardware_concurrency()));
}

/// Takes over what the recording decides.
core::Expected<Opening> begin_fork(ServeConfig& config) {
  std::error_code ignored;  // a file that is not there yet is no other one's equal
  if (config.record && fs::equivalent(*config.record, config.fork->recording, ignored))
    return core::fail("--record " + config.record->string(), "is the recording to go on from",
                      "a fork writes a recording of its own: name another file");
  auto opening = open_fork(*config.fork);
  if (!opening) return opening;
  config.tick_hz = opening->match->settings().tick_hz;
  if (const auto fits = check_state_hz(config.state_hz, config.tick_hz); !fits)
    return tl::unexpected(fits.error());
  const std::uint64_t begin = config.fork->tick;
  if (config.ticks) config.ticks = begin + std::min(*config.ticks, UINT64_MAX - begin);
  return opening;
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

core::Expected<std::unique_ptr<Server>> Server::create(ServeConfig config,
                                                       std::shared_ptr<spdlog::logger> log) {
  std::optional<Opening> fork;
  if (config.fork) {
    auto opening = begin_fork(config);
    if (!opening) return tl::unexpected(opening.error());
    fork = std::move(*opening);
  }
  std::unique_ptr<Server> server(new Server(config, std::move(log)));
  // The port first: a busy one must not cost somebody his recording.
  const auto endpoint = server->acceptor_.open(config.listen);
  if (!endpoint) return tl::unexpected(endpoint.error());
  server->address_ = to_text(*endpoint);
  if (config.shadow) server->shadows_.emplace(tick_threads(std::max<std::size_t>(1, config.maps.size())));
  const std::string name = fork ? fork->map->definition.name : std::string();
  const auto opened = fork ? server->open_room(config, name, std::move(*fork)) : server->open_rooms(config);
  if (!opened) return tl::unexpected(opened.error());
  return server;
}

core::Expected<void> Server::open_rooms(const ServeConfig& config) {
  const std::uint64_t seed = config.seed ? *config.seed : entropy();
  std::set<std::string> names;
  for (const fs::path& file : config.maps) {
    const auto map = map::load_map(file);
    if (!map) return tl::unexpected(map.error());
    const match::MatchSettings settings{config.tick_hz, seed + rooms_.size()};
    Opening opening{*map, std::make_unique<match::Match>(*map, settings), file.string(), {}, {}};
    const std::string name = unique_name((*map)->definition.name, names);
    if (auto opened = open_room(config, name, std::move(opening)); !opened) return opened;
  }
  return {};
}

core::Expected<void> Server::open_room(const ServeConfig& config, const std::string& name, Opening opening) {
  RoomSettings settings;
  settings.name = name;
  settings.state_hz = config.state_hz;
  settings.bots = config.bots;
  settings.tick_limit = config.ticks;
  settings.per_room = limits_.per_room;
  auto staff = hire(config, name, opening);
  if (!staff) return tl::unexpected(staff.error());
  const match::Match& match = *opening.match;
  if (opening.parent)
    log_->info("room {}: goes on from {}, tick {}, hash {}, with {} lice, {} ticks/s, {} frames/s", name,
               opening.parent->file, match.tick(), core::to_hex(match.hash()), match.world().lice().size(),
               config.tick_hz, config.state_hz);
  else
    log_->info("room {}: map {}, {} ticks/s, {} frames/s, seed {}", name, opening.map_file, config.tick_hz,
               config.state_hz, match.settings().seed);
  rooms_.push_back(
      std::make_unique<Room>(ticks_, io_, std::move(settings), std::move(opening), std::move(*staff), log_));
  lobby_.add(*rooms_.back());
  return {};
}

core::Expected<RoomStaff> Server::hire(const ServeConfig& config, const std::string& room,
                                       const Opening& opening) {
  RoomStaff staff;
  if (config.record) {
    auto opened = Recorder::open(recording_of(*config.record, room, config.maps.size()), disk_, log_);
    if (!opened) return tl::unexpected(opened.error());
    staff.recorder = std::move(*opened);
  }
  if (shadows_)
    staff.shadow = std::make_unique<Shadow>(room, opening.map, dump_of_shadow(config, room), *shadows_, log_);
  if (std::holds_alternative<map::TiledTerrain>(opening.map->definition.terrain)) {
    if (!ground_) ground_.emplace(1);
    staff.ahead = GroundAhead::make(*opening.map, *ground_);
  }
  return staff;
}

void Server::run() {
  auto ticks_work = asio::make_work_guard(ticks_);
  auto io_work = asio::make_work_guard(io_);
  await_signal();
  for (const auto& room : rooms_) room->start([this] { asio::post(strand_, [this] { room_ended(); }); });
  acceptor_.start();

  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < tick_threads(rooms_.size()); ++i)
    threads.emplace_back([this] { ticks_.run(); });
  for (std::size_t i = 0; i < kIoThreads; ++i) threads.emplace_back([this] { io_.run(); });
  threads.clear();
  disk_.join();
  if (shadows_) shadows_->join();
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
