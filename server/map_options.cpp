#include "server/map_options.h"

#include "server/option_checks.h"

namespace woodlouse::server {

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

}  // namespace woodlouse::server
