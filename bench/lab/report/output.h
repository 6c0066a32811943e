// Where a measurement goes: its tables as CSV files, its pictures drawn by gnuplot, each saying by which
// machine, commit and command it was made.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bench/lab/report/table.h"
#include "shared/core/error.h"

namespace CLI {
class App;
}

namespace woodlouse::lab {

enum class Effort { kQuick, kFull };

struct Output {
  std::filesystem::path folder = ".";
  std::filesystem::path pictures;  ///< empty: `folder`
  std::string commit = "not told";
  bool quick = false;
  std::string command;  ///< as it was called

  [[nodiscard]] Effort effort() const { return quick ? Effort::kQuick : Effort::kFull; }
  [[nodiscard]] core::Expected<void> write(const Table& table, std::string_view name) const;
  /// Draws `name`.svg and `name`.png; the script says all but the terminal. Without gnuplot it says so and is
  /// content.
  [[nodiscard]] core::Expected<void> draw(const std::string& script, std::string_view name, int width,
                                          int height) const;
  /// Lines of "# ..." that say what made this.
  [[nodiscard]] std::string preamble() const;
};

/// --quick, --out, --pictures, --commit. `output` must outlive the parse.
void add_output_options(CLI::App& app, Output& output);

}  // namespace woodlouse::lab
