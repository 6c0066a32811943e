// `figures`: the document's lost figures, drawn again.
#include "bench/lab/figures/figures.h"

#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <memory>

#include "bench/lab/job.h"

namespace woodlouse::lab {
namespace {

core::Expected<void> draw_all(const Output& output) {
  Findings findings;
  constexpr std::array kFigures = {draw_pots,     draw_planet,        draw_interpolated_terrain,
                                   draw_blending, draw_global_spline, draw_as_played};
  for (const auto draw : kFigures) {
    if (auto done = draw(output, findings); !done) return done;
  }
  std::cout << "\nWhat the figures show\n";
  findings.table().print(std::cout);
  return output.write(findings.table(), "document-figures");
}

}  // namespace

void add_figures(CLI::App& app, Job& job) {
  CLI::App* command = app.add_subcommand("figures", "Draws the document's lost figures again.");
  const auto output = std::make_shared<Output>();
  add_output_options(*command, *output);
  command->footer(
      "Writes document-2.2-parabolic, document-2.2-wavy and so on as .svg and .png, their numbers as .csv, "
      "and what docs/document.md quotes as document-figures.csv.\n"
      "Example:\n  woodlouse-lab figures --quick --out .");
  command->callback([output, &job] { job = [output] { return draw_all(*output); }; });
}

}  // namespace woodlouse::lab
