#include "server/cluster_options.h"

#include <unistd.h>

#include <CLI/CLI.hpp>

#include <array>
#include <utility>

#include "server/config.h"
#include "shared/protocol/whereabouts.h"

namespace woodlouse::server {
namespace {

constexpr const char* kClusterExamples =
    R"(FILE is the one of --cluster, as {"nats": ["nats://127.0.0.1:4222"]}.

Examples:
  woodlouse-server cluster init cluster.json
  woodlouse-server cluster status cluster.json
  woodlouse-server cluster move cluster.json --to b
  woodlouse-server cluster drain cluster.json a
  woodlouse-server cluster fsck cluster.json --out joined/)";

/// The system's name, as far as it can be one here.
std::string system_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  std::string host(name.data());
  return host.substr(0, host.find('.'));
}

/// What only a host that plays can do.
std::string of_players(const ServeConfig& serve) {
  if (!serve.maps.empty()) return "--map";
  if (serve.record) return "--record";
  if (serve.records) return "--records";
  if (serve.bots != 0) return "--bots";
  if (serve.shadow) return "--shadow";
  return serve.ticks ? "--ticks" : "";
}

}  // namespace

void add_cluster_options(CLI::App& app, TypedCluster& typed) {
  app.add_option("--cluster", typed.file,
                 "JSON file of a cluster, whose hosts have the same one: the rooms of --map live on one of "
                 "them, the others stand by and go on with them; left out: this server is alone")
      ->envname("WOODLOUSE_CLUSTER");
  app.add_option("--cluster-host", typed.host, "This host's name in its cluster; left out: the system's")
      ->envname("WOODLOUSE_CLUSTER_HOST");
  app.add_option("--cluster-address", typed.address,
                 "HOST:PORT at which clients of other hosts find this one; left out: that of --listen")
      ->envname("WOODLOUSE_CLUSTER_ADDRESS");
  app.add_flag("--cluster-edge", typed.is_edge,
               "This host plays nothing: it shows the cluster's rooms to spectators, from the log, and sends "
               "players on; there may be any number of such hosts, and they have no --map")
      ->envname("WOODLOUSE_CLUSTER_EDGE");
}

core::Expected<std::optional<ClusterSettings>> checked_cluster(const TypedCluster& typed,
                                                               const ServeConfig& serve) {
  if (!typed.file) {
    if (!typed.host && !typed.address && !typed.is_edge) return std::nullopt;
    return core::fail(typed.host      ? "--cluster-host"
                      : typed.is_edge ? "--cluster-edge"
                                      : "--cluster-address",
                      "there is no cluster", "say which:  --cluster FILE");
  }
  if (const std::string option = of_players(serve); typed.is_edge && !option.empty())
    return core::fail(option, "with --cluster-edge nothing is played here", "leave one of the two out");
  if (serve.fork) return core::fail("--cluster", "a fork is played alone");
  if (serve.rotate)
    return core::fail("--rotate", "in a cluster each room plays one game for good",
                      "leave one of the two out");
  auto settings = read_cluster_settings(*typed.file);
  if (!settings) return tl::unexpected(settings.error());
  settings->is_edge = typed.is_edge;
  settings->host = typed.host ? *typed.host : system_name();
  if (!is_cluster_name(settings->host))
    return core::fail("--cluster-host", "\"" + settings->host + "\" is no name of letters, digits, - and _",
                      "give this host one:  --cluster-host a");
  if (typed.address) {
    auto address = parse_listen_address(*typed.address, "--cluster-address");
    if (!address) return tl::unexpected(address.error());
    settings->address = to_text(*address);
    if (!protocol::parse_host_address(settings->address))
      return core::fail("--cluster-address " + *typed.address,
                        "is no HOST:PORT at which clients find this host", "for example 192.0.2.7:7777");
  }
  return std::optional(std::move(*settings));
}

CLI::App* add_cluster_command(CLI::App& app, TypedClusterErrand& typed) {
  using Action = ClusterErrand::Action;
  CLI::App* cluster = app.add_subcommand("cluster", "Make, look at or prove the log of a cluster");
  const auto add = [&](Action action, const char* name, const char* what) {
    CLI::App* command = cluster->add_subcommand(name, what);
    command->add_option("file", typed.file, "The cluster's file")->required();
    command->footer(std::string());
    command->final_callback([&typed, action] { typed.errand.action = action; });
    return command;
  };
  add(Action::kInit, "init", "Make the log, once; one that is there stays as it is");
  add(Action::kStatus, "status", "Who owns the rooms, who stands by, what is in the log");
  add(Action::kFsck, "fsck", "Read all of the log, re-run every room and name every hole")
      ->add_option("--out", typed.errand.out, "Folder for each room's joined recording");
  add(Action::kMove, "move", "Have the rooms go on at another host, without a game that stops")
      ->add_option("--to", typed.errand.host, "At that one; left out: at whoever is next");
  add(Action::kDrain, "drain",
      "Have a host give its rooms away, and take none any more until it is started anew")
      ->add_option("host", typed.errand.host, "Its name")
      ->required();
  cluster->require_subcommand(1, 1);
  cluster->footer(kClusterExamples);
  return cluster;
}

core::Expected<ClusterErrand> checked_cluster_errand(const TypedClusterErrand& typed) {
  auto settings = read_cluster_settings(typed.file);
  if (!settings) return tl::unexpected(settings.error());
  ClusterErrand errand = typed.errand;
  errand.settings = std::move(*settings);
  errand.settings.host = "operator";
  return errand;
}

}  // namespace woodlouse::server
