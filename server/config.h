// What the command line, WOODLOUSE_* variables and a JSON file ask of the server.
// Flag over variable over file over default; every value is checked here, once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "server/admin/admin_address.h"
#include "server/bots/skill.h"
#include "server/cluster/cluster_command.h"
#include "server/cluster/cluster_settings.h"
#include "server/commands/admin.h"
#include "server/commands/fork.h"
#include "server/commands/inspect.h"
#include "server/commands/make_map.h"
#include "server/commands/records.h"
#include "server/commands/verify.h"
#include "server/log.h"
#include "server/net/listen_address.h"
#include "server/proxies/trusted_proxies.h"
#include "server/watchers/recordings.h"
#include "server/web_options.h"
#include "shared/core/error.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

/// Each steps all the time; a longer list is a slip.
inline constexpr std::size_t kMaxRooms = 1024;

struct ServeConfig {
  std::vector<std::filesystem::path> maps;  ///< a room each and mode; 1 to kMaxRooms, none for a fork
  std::optional<ForkPoint> fork;            ///< one room, whose map, tick rate and seed are the recording's
  ListenAddress listen;
  TrustedProxies trusted_proxies;      ///< who may say for whom a connection or a request is
  std::optional<WebSettings> web;      ///< where the client speaks first; empty: nowhere
  std::optional<AdminSettings> admin;  ///< the operator's door; empty: there is none
  std::optional<std::filesystem::path> ban_file;
  std::optional<std::filesystem::path> password_file;  ///< empty: everybody may join
  bool may_passwords_be_plain = false;                 ///< from other machines, without TLS
  std::uint32_t tick_hz = 60;                          ///< 1..1000
  std::uint32_t state_hz = 20;                         ///< divides tick_hz
  std::optional<RecordSettings> record;
  std::optional<std::filesystem::path> records;  ///< the folder of the races' boards; empty: there are none
  std::optional<ClusterSettings> cluster;        ///< empty: this server is alone
  bool shadow = false;                           ///< re-run and compare each tick beside the game
  std::optional<std::uint64_t> ticks;            ///< stop after so many
  std::optional<std::uint64_t> seed;             ///< empty: from the machine's entropy
  std::optional<state::Mode> mode;               ///< empty: each that a map has, a room each
  std::optional<std::uint32_t> rotate;           ///< one room for all of them, each for so many rounds
  std::uint32_t bots = 0;                        ///< of the house, in every room
  bots::Skill bots_skill = bots::Skill::kFair;
  bool bots_alone_play = false;    ///< they keep a room awake in which nobody is
  std::uint32_t step_threads = 1;  ///< 1..core::ThreadTeam::kMostThreads; of a big room's tick
  LogFormat log_format = LogFormat::kText;
  std::optional<std::filesystem::path> log_file;  ///< empty: standard error
  std::string log_level = "info";                 ///< of log_levels()
  protocol::Limits limits;  ///< messages_per_s and burst 0: by the tick rate (limits_of)
};

struct CheckConfig {
  std::vector<std::filesystem::path> maps;
  bool summary = false;
};
struct MakeMapConfig {
  MakeMapRequest request;  ///< crop: none or four numbers; scale: in its range
};
struct VerifyConfig {
  VerifyRequest request;  ///< jobs: 1..256
};
struct InspectConfig {
  InspectRequest request;
};
struct RecordsConfig {
  RecordsRequest request;
};
struct ClusterConfig {
  ClusterErrand errand;
};
struct AdminConfig {
  AdminErrand errand;
};
/// Help or the version was asked for.
struct PrintConfig {
  std::string text;
};

using Config = std::variant<ServeConfig, CheckConfig, MakeMapConfig, VerifyConfig, InspectConfig,
                            RecordsConfig, AdminConfig, ClusterConfig, PrintConfig>;

/// Frames fall on ticks. Of a fork it is known once its recording is read.
core::Expected<void> check_state_hz(std::uint32_t state_hz, std::uint32_t tick_hz);

/// What hello declares: as many connections as there may be files open, some of which the server needs
/// itself.
protocol::Limits limits_of(const ServeConfig& config, std::uint64_t may_be_open);

/// Errors: where = the option, or FILE: key of the config file.
core::Expected<Config> parse_config(int argc, const char* const* argv);

}  // namespace woodlouse::server
