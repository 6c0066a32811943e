// One run of woodlouse-scenario: reads, plays, and reports or updates.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <vector>

#include "bench/scenario/golden_register.h"
#include "bench/scenario/options.h"
#include "bench/scenario/play.h"
#include "bench/scenario/scenario.h"

namespace woodlouse::scenario {

/// What the process returns.
enum class Exit { kSame = 0, kDiffers = 1, kUnusable = 2, kNotRun = 3 };

class Session {
 public:
  /// Table and verdict go to `out`, everything else to `log`.
  Session(const Options& options, std::ostream& out, std::ostream& log)
      : options_(options), out_(out), log_(log) {}

  Exit run();

 private:
  bool read();
  bool read_registers();
  void choose_instructions();
  void play();
  void check(const Scenario& scenario, const Play& played);
  void update(const Scenario& scenario, const Play& played);
  bool write_registers();
  void tell(const core::Error& error);

  const Options& options_;
  std::ostream& out_;
  std::ostream& log_;
  std::vector<Scenario> scenarios_;
  std::map<std::filesystem::path, GoldenRegister> registers_;  ///< by folder
  std::vector<physics::InstructionSet> instructions_;
  std::vector<std::unique_ptr<Play>>
      plays_;  ///< those of a scenario lie together, in the order of scenarios_
  std::size_t wrong_ = 0;
};

}  // namespace woodlouse::scenario
