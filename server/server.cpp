#include "server/server.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <csignal>
#include <cstdint>
#include <random>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

#include "server/commands/fork.h"
#include "server/logging/events.h"
#include "server/version.h"
#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/core/stable_hash.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;

/// Where games take turns.
constexpr const char* kRotationRoom = "rotation";

std::size_t tick_threads(std::size_t rooms) {
  return std::min<std::size_t>(rooms, std::max(1u, std::thread::hardware_concurrency()));
}

/// Takes over what the recording decides.
core::Expected<Start> begin_fork(ServeConfig& config) {
  auto start = open_fork(*config.fork);
  if (!start) return start;
  config.tick_hz = start->match->settings().tick_hz;
  if (const auto fits = check_state_hz(config.state_hz, config.tick_hz); !fits)
    return tl::unexpected(fits.error());
  const std::uint64_t begin = config.fork->tick;
  if (config.ticks) config.ticks = begin + std::min(*config.ticks, UINT64_MAX - begin);
  return start;
}

std::uint64_t entropy() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

}  // namespace

Server::Server(const ServeConfig& config, Outside outside, std::shared_ptr<spdlog::logger> log)
    : log_(std::move(log)),
      companions_(log_),
      io_(static_cast<int>(kIoThreads)),
      lanes_(io_, kIoThreads),
      strand_(asio::make_strand(io_)),
      signals_(strand_),
      deadline_(strand_),
      outside_(std::move(outside)),
      had_terminal_(has_terminal()),
      limits_(limits_of(config, raise_descriptor_limit())),
      environment_{guide_, limits_, traffic_, timekeeper_, kServerName, log_},
      acceptor_(lanes_, environment_),
      opener_(ticks_, lanes_, limits_, companions_, timekeeper_, log_),
      room_control_(strand_, lobby_, opener_, companions_, limits_, config,
                    {[this](std::shared_ptr<Room> room) { return open(std::move(room)); },
                     [this](const std::string& room) { rooms_running_.erase(room); }},
                    log_),
      moderation_(strand_, lobby_, acceptor_, *doorman_, ban_desk_, log_),
      metrics_({lobby_, traffic_, limits_, timekeeper_, companions_.recordings(), outside_.lost_log_lines,
                kVersion,
                [this] { return cluster_ ? std::optional(cluster_->cluster().figures()) : std::nullopt; }}),
      operator_(strand_, lobby_, traffic_, timekeeper_, metrics_,
                {guide_, room_control_, moderation_, *doorman_,
                 [this](auto done) { reload("admin", std::move(done)); },
                 [this](const std::string& text, const std::string& reason) { stop(text, reason); },
                 [this] { return stopping_; }},
                log_),
      admin_(io_, operator_, timekeeper_, log_) {
  environment_.doorman = doorman_.get();
  environment_.moderate = [this](protocol::Moderate wish, std::string room, std::string who,
                                 std::function<void(protocol::ServerMessage)> answered) {
    operator_.moderate(std::move(wish), std::move(room), std::move(who), std::move(answered));
  };
}

Server::~Server() {
  // These go first: what they leave behind touches nothing of the others.
  rotation_.reset();
  companions_.drop_files();
}

core::Expected<std::unique_ptr<Server>> Server::create(ServeConfig config, Outside outside,
                                                       std::shared_ptr<spdlog::logger> log) {
  std::optional<Start> fork;
  if (config.fork) {
    auto start = begin_fork(config);
    if (!start) return tl::unexpected(start.error());
    fork = std::move(*start);
  }
  std::unique_ptr<Server> server(new Server(config, std::move(outside), std::move(log)));
  // The ports first: a busy one must not cost somebody his recording.
  if (const auto opened = server->open_ports(config); !opened) return tl::unexpected(opened.error());
  server->companions_.begin(config, tick_threads(std::max<std::size_t>(1, config.maps.size())));
  const auto opened = fork             ? server->open_fork_room(config, std::move(*fork))
                      : config.cluster ? server->join_cluster(config)
                                       : server->open_rooms(config);
  if (!opened) return tl::unexpected(opened.error());
  return server;
}

core::Expected<void> Server::open_ports(const ServeConfig& config) {
  const auto lines = acceptor_.open(config.listen, config.trusted_proxies);
  if (!lines) return tl::unexpected(lines.error());
  address_ = to_text(*lines);
  if (config.web) {
    const auto web = acceptor_.open_web(*config.web);
    if (!web) return tl::unexpected(web.error());
    environment_.web_url = core::joined({"http://", to_text(reachable(*web)), "/"});
  }
  if (const auto passwords = use_passwords(config); !passwords) return passwords;
  if (config.admin || config.ban_file || config.password_file) ban_desk_.emplace(doorman_, config.ban_file);
  if (ban_desk_)
    if (const auto bans = ban_desk_->read(); !bans) return tl::unexpected(bans.error());
  if (!config.admin) return {};
  room_control_.begin();
  auto admin = admin_.open(*config.admin);
  if (!admin) return tl::unexpected(admin.error());
  admin_address_ = std::move(*admin);
  return {};
}

core::Expected<void> Server::open_rooms(const ServeConfig& config) {
  const std::uint64_t seed = config.seed ? *config.seed : entropy();
  auto games = choose_games(config);
  if (!games) return tl::unexpected(games.error());
  if (!config.cluster) take_signals();
  if (config.rotate) return open_rotation(config, std::move(*games), seed);
  for (std::size_t k = 0; k < games->size(); ++k) {
    const ChosenGame& game = (*games)[k];
    if (lobby_.find(game.room) != nullptr) continue;  // it goes on from a cluster's log
    if (auto opened = open_room(config, game.room, start_of(game, config, seed + k)); !opened) return opened;
  }
  return {};
}

core::Expected<void> Server::open_rotation(const ServeConfig& config, std::vector<ChosenGame> games,
                                           std::uint64_t seed) {
  Start first = start_of(games.front(), config, seed);
  log_event(*log_, LogEvent::kRotationOpened,
            fmt::format("room {}: {} games in turns, of {} rounds each", kRotationRoom, games.size(),
                        *config.rotate));
  // What can't be written any more costs the record, not the game.
  rotation_.emplace(std::move(games), seed, [this, config](const ChosenGame& game, std::uint64_t its_seed) {
    std::vector<core::Error> failed;
    NextGame next{start_of(game, config, its_seed), {}};
    next.watchers = companions_.make(kRotationRoom, next.start, failed);
    for (const core::Error& error : failed)
      log_event(*log_, LogEvent::kGameNotWritten,
                fmt::format("room {}: NOT WRITTEN: {}: {}", kRotationRoom, error.where, error.what));
    next.start.match->use(companions_.step_team());
    return next;
  });
  return open_room(config, kRotationRoom, std::move(first));
}

core::Expected<void> Server::join_cluster(const ServeConfig& config) {
  cluster_.emplace(strand_, lobby_, limits_, ClusterDesk::Stage{ticks_, lanes_, timekeeper_},
                   ClusterDesk::Rooms{[this, config] { return open_rooms(config); },
                                      [this, config](const std::string& name, Start start) {
                                        return open_room(config, name, std::move(start));
                                      },
                                      [this](const std::string& name) { rooms_running_.erase(name); },
                                      [this](const std::string& why) {
                                        log_event(*log_, LogEvent::kClusterFault, why);
                                        stop("the server stops", why);
                                      }},
                   log_);
  if (const auto opened = cluster_->open(config, address_, environment_.web_url); !opened)
    return tl::unexpected(opened.error());
  companions_.use(cluster_->cluster());
  cluster_->guide(guide_, environment_);
  take_signals();
  return {};
}

core::Expected<void> Server::open_fork_room(const ServeConfig& config, Start start) {
  take_signals();
  const std::string name = room_name(start.map->definition.name, start.match->settings().mode);
  return open_room(config, name, std::move(start));
}

core::Expected<void> Server::use_passwords(const ServeConfig& config) {
  if (!config.password_file) return {};
  auto passwords = read_passwords(*config.password_file);
  if (!passwords) return tl::unexpected(passwords.error());
  doorman_->use(std::move(*passwords),
                config.may_passwords_be_plain ? Doorman::Plain::kAllowed : Doorman::Plain::kRefused);
  return {};
}

core::Expected<void> Server::open_room(const ServeConfig& config, const std::string& name, Start start) {
  auto room = opener_.make(config, name, std::move(start), rotation_ ? &*rotation_ : nullptr);
  if (!room) return tl::unexpected(room.error());
  [[maybe_unused]] const bool is_new = open(std::move(*room));
  assert(is_new || stopping_);
  return {};
}

bool Server::open(std::shared_ptr<Room> room) {
  if (cluster_ && !cluster_->owns()) return false;
  const std::string name = room->name();
  rooms_running_.insert(name);
  if (lobby_.open(std::move(room), [this, name] { asio::post(strand_, [this, name] { room_ended(name); }); }))
    return true;
  if (lobby_.find(name) == nullptr) rooms_running_.erase(name);
  return false;
}

void Server::run() {
  auto ticks_work = asio::make_work_guard(ticks_);
  auto io_work = asio::make_work_guard(io_);
  await_signal();
  const std::size_t rooms = lobby_.rooms().size();  // their first ticks are due when the threads run
  acceptor_.start();
  admin_.start();
  if (cluster_) cluster_->start();

  std::vector<std::jthread> threads;
  try {
    for (std::size_t i = 0; i < tick_threads(admin_address_.empty() && !cluster_ ? rooms : kMaxRooms); ++i)
      threads.emplace_back([this] { ticks_.run(); });
    for (std::size_t i = 0; i < kIoThreads; ++i) threads.emplace_back([this] { io_.run(); });
  } catch (const std::system_error&) {
    stop_contexts();  // or those that run would never end
    throw;
  }
  threads.clear();
  if (cluster_) cluster_->leave();
  rotation_.reset();
  room_control_.end();
  companions_.end();
}

void Server::on_signal(int signal) {
  const bool lost_terminal = signal == SIGHUP && had_terminal_ && !has_terminal();
  if (signal == SIGUSR1 || (signal == SIGHUP && !lost_terminal)) {
    if (signal == SIGUSR1) reopen();
    if (signal == SIGHUP) reload("SIGHUP", [](const auto&) {});  // the log says it
    return await_signal();
  }
  const std::string name = core::joined({"SIG", ::sigabbrev_np(signal)});
  log_event(*log_, LogEvent::kStopping, fmt::format("{}: stopping", name));
  stop("the server stops", name);
}

/// What may change while games go on. What can't be used is as it was, and nothing behind it is looked at.
void Server::reload(const std::string& who, Operator::Reloaded done) {
  const auto refuse = [this, who, done](const core::Error& error, const std::string& what) {
    log_event(*log_, LogEvent::kReloadFailed,
              fmt::format("{}: {}: {}: {}", who, what, error.where, error.what));
    done(tl::unexpected(core::Error(error.where, what + ": " + error.what, error.hint)));
  };
  const auto config = outside_.reread();
  if (!config) return refuse(config.error(), "nothing is changed");
  std::string read = "limits and log level";
  if (config->web && config->web->tls) {
    if (const auto tls = acceptor_.reread(*config->web); !tls)
      return refuse(tls.error(), "nothing is changed, the old certificate serves on");
    read += ", certificate";
  }
  log_->set_level(spdlog::level::from_str(config->log_level));
  const protocol::Limits limits = limits_of(*config, raise_descriptor_limit());
  limits_.replace(limits);
  for (const auto& room : lobby_.rooms()) room->use(limits);
  if (const auto passwords = use_passwords(*config); !passwords)
    return refuse(passwords.error(),
                  read + " are read again, the passwords are as they were, and so are the bans");
  if (config->password_file) read += ", passwords";
  const auto finish = [this, who, done](const std::string& all) {
    const std::string text = all + " are read again; limits of a session hold for who comes from now on";
    log_event(*log_, LogEvent::kReloaded, fmt::format("{}: {}", who, text));
    done(text);
  };
  if (!ban_desk_ || !ban_desk_->has_file()) return finish(read);
  const std::string but = read + " are read again, the bans are as they were";
  const bool is_taken =
      ban_desk_->reread([this, refuse, finish, read, but](const core::Expected<void>& reread) {
        if (!reread) return refuse(reread.error(), but);
        moderation_.enforce_bans([finish, read](std::size_t ended) {
          finish(read + (ended == 0 ? ", bans" : fmt::format(", bans ({} of whom are put out)", ended)));
        });
      });
  if (!is_taken) refuse({"--ban-file", "too many changes wait for the disk"}, but);
}

void Server::reopen() {
  outside_.reopen_log();
  const std::size_t rooms = companions_.ask_for_next_files();
  log_event(*log_, LogEvent::kReopened,
            rooms == 0 ? std::string("SIGUSR1: no room is recorded: no recording begins")
                       : fmt::format("SIGUSR1: the recordings of {} rooms go on in new files from their next "
                                     "keyframe on",
                                     rooms));
}

void Server::stop_parts(const std::string& text, const std::string& reason) {
  if (std::exchange(parts_stop_, true)) return;
  protocol::Bye bye{std::string(protocol::code::kShutdown), text, false};
  if (cluster_) bye = cluster_->begin_leaving(bye);
  deadline_.expires_after(kStopWithin);
  deadline_.async_wait([this](const boost::system::error_code& error) {
    if (!error) give_up_waiting();
  });
  const auto part_done = [this] { asio::post(strand_, [this] { part_stopped(); }); };
  parts_running_ = 2 + lobby_.stop(bye, reason, part_done);
  acceptor_.stop(bye, part_done);
  admin_.stop(part_done);
}

void Server::give_up_waiting() {
  log_event(*log_, LogEvent::kStopIncomplete,
            fmt::format("{} of rooms and port did not stop within {} ms", parts_running_,
                        std::chrono::duration_cast<std::chrono::milliseconds>(kStopWithin).count()));
  stop_contexts();
}

void Server::print_summary(std::ostream& out) const {
  for (const auto& room : lobby_.rooms())
    out << core::printable(summary(room->name(), *room->figures())) << '\n';
  out << "frames sent " << traffic_.frames_sent << ", bytes sent " << traffic_.bytes_sent
      << ", lines received " << traffic_.lines_received << '\n';
  for (const std::string& lost : lost_recordings())
    out << "RECORDING LOST: " << core::printable(lost) << '\n';
  for (const std::string& lost : lost_records()) out << "RECORD LOST: " << core::printable(lost) << '\n';
}

}  // namespace woodlouse::server
