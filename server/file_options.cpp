#include "server/file_options.h"

#include "server/option_checks.h"

namespace woodlouse::server {
namespace {

constexpr std::uint64_t kMaxJobs = 256;

}  // namespace

CLI::App* add_check(CLI::App& app, CheckConfig& config) {
  CLI::App* check = app.add_subcommand("check", "Say what is wrong with map files");
  check->add_option("map", config.maps, "Map files")->required();
  check->add_flag("--summary", config.summary, "And what their ground is like: size, slopes, cost");
  return check;
}

CLI::App* add_make_map(CLI::App& app, MakeMapRequest& request) {
  CLI::App* make_map =
      app.add_subcommand("make-map", "Make a map of an elevation file: .asc, .grd, .flt or .hgt");
  make_map->add_option("file", request.file, "The elevation file")->required();
  make_map->add_option("--out", request.out, "The map file; FILE with the ending .json, if not given");
  make_map
      ->add_option(
          "--crop", request.crop,
          "West,south,east,north in the file's own coordinates: degrees, or metres as its header has them")
      ->delimiter(',')
      ->expected(4)
      ->check(number_within(-1e9, 1e9, "from -1e9 to 1e9"));
  make_map->add_option("--scale", request.scale, "Factor on lengths and heights alike")
      ->check(number_within(1e-6, 1e6, "from 1e-6 to 1e6"));
  make_map->add_option("--name", request.name, "The map's name; the file's, if not given");
  make_map->add_flag("--modes", request.modes, "A race, crumbs and a hill to hold, too");
  return make_map;
}

void add_maps(CLI::App& command, std::filesystem::path& maps) {
  command
      .add_option("--maps", maps,
                  "Folder of the map, where the recording only names it and it is not beside it")
      ->check(CLI::ExistingDirectory);
}

CLI::App* add_verify(CLI::App& app, VerifyRequest& request) {
  CLI::App* verify = app.add_subcommand(
      "verify",
      "Re-run a recording and compare: places and hashes, inputs, who joined under which name and left, and "
      "the index. Chat, margins, that a server played this game and that it ended there are what the file "
      "says");
  verify->add_option("file", request.files, "Recordings")->required();
  verify->add_option("--jobs", request.jobs, "Threads; each takes a stretch between keyframes")
      ->check(whole_number(1, kMaxJobs))
      ->capture_default_str();
  verify->add_flag("--from-start", request.from_start, "Fail where the start is taken on trust");
  verify->add_flag("--complete", request.complete, "Fail where the end is missing");
  add_maps(*verify, request.maps);
  return verify;
}

CLI::App* add_inspect(CLI::App& app, InspectRequest& request) {
  CLI::App* inspect =
      app.add_subcommand("inspect", "Say what a recording holds, or the exact state at a tick");
  inspect->add_option("file", request.file, "A recording")->required();
  CLI::Option* tick =
      inspect->add_option("--tick", request.tick, "The state at this tick, as JSON")->check(whole_number(0));
  inspect->add_option("--at", request.seconds, "The same, by seconds since the game began")
      ->check(number_of_seconds())
      ->excludes(tick);
  add_maps(*inspect, request.maps);
  inspect->add_flag(
      "--rulings", request.rulings,
      "What the rules of play said, re-run, a line each: moment (1/65536 of a tick), kind, louse, values");
  inspect->add_flag("--error", request.error,
                    "How far its steps err, re-run, and how far it goes astray in 10 s");
  inspect->add_flag("--summary", request.summary,
                    "Players, inputs, events, and who was late; also without an option");
  return inspect;
}

}  // namespace woodlouse::server
