// `sample`: a surface's height, gradient and Hessian at given points.
#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <sstream>
#include <utility>
#include <variant>
#include <vector>

#include "bench/lab/job.h"
#include "bench/lab/problems/surface_choice.h"
#include "bench/lab/report/numbers.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/table.h"
#include "shared/core/vec2.h"
#include "shared/core/whole_file.h"
#include "shared/terrain/outside_policy.h"

namespace woodlouse::lab {
namespace {

struct SampleOptions {
  SurfaceOptions surface;
  std::string points;
  std::string outside = "nothing";
  bool quick = false;
};

constexpr std::size_t kQuickPoints = 1000;

core::Expected<std::vector<core::Vec2>> read_points(std::istream& in, const std::string& source) {
  std::vector<core::Vec2> points;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || (number == 1 && line == "x,y")) continue;
    const auto xy = numbers_of<2>(line);
    if (!xy)
      return core::fail(source + ":" + std::to_string(number), "\"" + line.substr(0, 60) + "\" is not x,y",
                        "two finite numbers with a comma between them; a first line x,y may stand above");
    points.push_back({(*xy)[0], (*xy)[1]});
  }
  return points;
}

core::Expected<std::vector<core::Vec2>> read_points(const std::string& source) {
  if (source == "-") return read_points(std::cin, "standard input");
  constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  auto bytes = core::read_whole_file(source, kMaxBytes);
  if (!bytes)
    return core::fail(bytes.error().where, bytes.error().what,
                      "--points takes a CSV file of x,y, or - for standard input");
  std::istringstream in(std::move(*bytes));
  return read_points(in, source);
}

void print_row(core::Vec2 p, const std::optional<terrain::SurfaceSample>& s, bool has_hessian) {
  std::cout << exact_text(p.x) << ',' << exact_text(p.y);
  if (!s) {
    std::cout << ",,,,,,\n";
    return;
  }
  for (const double value : {s->z, s->zx, s->zy}) std::cout << ',' << exact_text(value);
  for (const double value : {s->zxx, s->zxy, s->zyy})
    std::cout << ',' << (has_hessian ? exact_text(value) : "");
  std::cout << '\n';
}

core::Expected<void> run(const SampleOptions& options) {
  const auto surface = make_surface(options.surface);
  if (!surface) return tl::unexpected(surface.error());
  auto points = read_points(options.points);
  if (!points) return tl::unexpected(points.error());
  if (options.quick && points->size() > kQuickPoints) points->resize(kQuickPoints);
  const auto policy =
      options.outside == "extend" ? terrain::OutsidePolicy::kExtend : terrain::OutsidePolicy::kNothing;
  std::cout << "x,y,z,zx,zy,zxx,zxy,zyy\n";
  Progress progress("sample", points->size());
  std::visit(
      [&]<typename S>(const S& s) {
        for (const core::Vec2 p : *points) {
          print_row(p, terrain::sample_anywhere(s, p.x, p.y, policy), terrain::kHasHessian<S>);
          progress.advance();
        }
      },
      *surface);
  if (!std::cout.flush()) return core::fail("standard output", "can't be written");
  return {};
}

}  // namespace

void add_sample(CLI::App& app, Job& job) {
  CLI::App* command =
      app.add_subcommand("sample", "Prints a surface's height, gradient and Hessian at given points.");
  const auto options = std::make_shared<SampleOptions>();
  add_surface_options(*command, options->surface, MapOption::kOffered);
  command->add_option("--points", options->points, "CSV of x,y, or - for standard input")->required();
  command
      ->add_option("--outside", options->outside,
                   "points outside the domain: nothing (empty fields) or extend")
      ->check(CLI::IsMember({"nothing", "extend"}))
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "the first 1000 points only");
  command->footer(
      "Prints x,y,z,zx,zy,zxx,zxy,zyy with 17 digits; fields that the surface has not are empty.\n"
      "Example:\n  echo 0.25,-0.5 | woodlouse-lab sample --surface not_a_knot --function volcano --grid 10 "
      "--points -");
  command->callback([options, &job] { job = [options] { return run(*options); }; });
}

}  // namespace woodlouse::lab
