#include "bench/lab/report/output.h"

#include <stdlib.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>

namespace woodlouse::lab {
namespace {

namespace fs = std::filesystem;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string load() {
  std::ifstream info("/proc/loadavg");
  std::string one;
  info >> one;
  return one.empty() ? "unknown" : one;
}

bool is_on_path(const std::string& program) {
  const char* path = getenv("PATH");
  std::stringstream folders(path == nullptr ? "" : path);
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

core::Expected<void> plot(const std::string& script) {
  FILE* const pipe = popen("gnuplot", "w");  // NOLINT: a fixed text, no user's
  if (pipe == nullptr) return core::fail("gnuplot", "can't be started");
  const bool sent = fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (pclose(pipe) != 0 || !sent)
    return core::fail("gnuplot", "did not draw the picture", "the CSV files stand");
  return {};
}

}  // namespace

std::string Output::preamble() const {
  std::ostringstream out;
  out << "# machine: " << processor() << ", " << std::thread::hardware_concurrency() << " cores, load "
      << load() << ", "
#ifdef __clang__
      << "clang " << __clang_major__
#else
      << "g++ " << __GNUC__ << '.' << __GNUC_MINOR__
#endif
      << "\n# commit: " << commit << "\n# command: " << command << '\n';
  return out.str();
}

core::Expected<void> Output::write(const Table& table, std::string_view name) const {
  const fs::path file = folder / (std::string(name) + ".csv");
  const auto done = table.write_csv(file, preamble());
  if (done) std::cout << "wrote " << file.string() << '\n';
  return done;
}

core::Expected<void> Output::draw(const std::string& script, std::string_view name, int width,
                                  int height) const {
  if (!is_on_path("gnuplot")) {
    std::cout << "gnuplot is missing (Debian: gnuplot-nox): no picture " << name << '\n';
    return {};
  }
  const fs::path base = (pictures.empty() ? folder : pictures) / std::string(name);
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  for (const auto& [terminal, suffix] : {std::pair{"svg background rgb 'white' font 'sans,12'", ".svg"},
                                         std::pair{"pngcairo font 'sans,10'", ".png"}}) {
    const std::string file = base.string() + suffix;
    if (file.find_first_of("'\n") != std::string::npos) return core::fail(file, "can't be a picture's name");
    std::ostringstream whole;
    whole << "set terminal " << terminal << " size " << size << "\nset output '" << file << "'\n" << script;
    if (auto done = plot(whole.str()); !done) return done;
    std::cout << "wrote " << file << '\n';
  }
  return {};
}

void add_output_options(CLI::App& app, Output& output) {
  app.add_flag("--quick", output.quick, "a smaller measurement of a few seconds");
  app.add_option("--out", output.folder, "folder of the CSV files")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_option("--pictures", output.pictures, "folder of the pictures; that of the CSV files when left out")
      ->check(CLI::ExistingDirectory);
  app.add_option("--commit", output.commit, "what to write into the files as the commit");
  output.command = "woodlouse-lab " + app.get_name();
  app.parse_complete_callback([&output] {
    if (output.quick) output.command += " --quick";
  });
}

}  // namespace woodlouse::lab
