#include "bench/scenario/session.h"

#include <ostream>
#include <span>

#include "bench/scenario/scenario_reader.h"
#include "bench/scenario/verdict.h"
#include "bench/scenario/whole_write.h"
#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/core/thread_team.h"

namespace woodlouse::scenario {

void Session::tell(const core::Error& error) {
  ++wrong_;
  log_ << error.text() << '\n';
}

bool Session::read() {
  const auto files = find_scenarios(options_.places);
  if (!files) {
    tell(files.error());
    return false;
  }
  for (const std::filesystem::path& file : *files) {
    ReadScenario read = read_scenario(file, options_.maps);
    for (const core::Error& error : read.errors) tell(error);
    if (read.scenario) scenarios_.push_back(std::move(*read.scenario));
  }
  return wrong_ == 0;
}

bool Session::read_registers() {
  for (const Scenario& scenario : scenarios_) {
    const std::filesystem::path folder = scenario.file.parent_path();
    std::error_code error;
    if (registers_.contains(folder)) continue;
    if (!std::filesystem::exists(folder / kRegisterName, error)) {
      if (options_.goldens == Goldens::kUpdate) registers_.emplace(folder, GoldenRegister{});
      continue;
    }
    auto read = GoldenRegister::read(folder / kRegisterName);
    if (!read) {
      tell(read.error());
      return false;
    }
    registers_.emplace(folder, std::move(*read));
  }
  return true;
}

void Session::choose_instructions() {
  using physics::InstructionSet;
  for (const InstructionSet set : {InstructionSet::kScalar, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (options_.instructions && *options_.instructions != set) continue;
    if (physics::is_available(set)) {
      instructions_.push_back(set);
    } else {
      log_ << physics::to_text(set) << ": not run, this machine or build has none\n";
    }
  }
}

void Session::play() {
  std::shared_ptr<core::Team> team;
  if (options_.step_threads > 1)
    team = std::make_shared<core::ThreadTeam>(options_.step_threads, core::Cut::kFinest);
  for (const Scenario& scenario : scenarios_) {
    for (const physics::InstructionSet set : instructions_) {
      for (std::size_t room = 0; room < options_.rooms; ++room)
        plays_.push_back(std::make_unique<Play>(scenario, set, team));
    }
  }
  play_all(plays_, options_.threads);
}

void Session::check(const Scenario& scenario, const Play& played) {
  const std::size_t before = wrong_;
  for (const core::Error& error : differences(scenario, played)) tell(error);
  if (wrong_ != before) return;
  const auto found = registers_.find(scenario.file.parent_path());
  if (found == registers_.end()) return;
  if (const auto error = found->second.check(scenario)) tell(*error);
}

void Session::update(const Scenario& scenario, const Play& played) {
  const std::uint64_t hashes = golden_digest(played.hashes());
  const auto found = registers_.find(scenario.file.parent_path());
  if (found != registers_.end()) {
    if (const auto error = found->second.forbids(scenario, match::kBehavior, hashes)) return tell(*error);
    found->second.set(scenario.name, {match::kBehavior, script_digest(scenario), hashes});
  }
  const std::string text = updated_text(scenario, played);
  if (text == scenario.text) return;
  if (const auto error = write_whole_file(scenario.file, text)) return tell(*error);
  log_ << core::printable(scenario.file.string()) << ": updated\n";
}

bool Session::write_registers() {
  for (auto& [folder, golden_register] : registers_) {
    golden_register.drop_missing(folder);
    if (const auto error = write_whole_file(folder / kRegisterName, golden_register.text())) {
      tell(*error);
      return false;
    }
  }
  return true;
}

Exit Session::run() {
  if (!read() || !read_registers()) return Exit::kUnusable;
  choose_instructions();
  if (instructions_.empty()) return Exit::kNotRun;
  play();
  const std::size_t each = instructions_.size() * options_.rooms;
  std::size_t hashes = 0;
  for (std::size_t k = 0; k < scenarios_.size(); ++k) {
    const auto plays = std::span<const std::unique_ptr<Play>>(plays_).subspan(k * each, each);
    const Play& played = *plays.front();
    hashes += played.hashes().size();
    if (options_.output == Output::kTable) out_ << table_of(played);
    if (const auto error = disagreement(plays)) {
      tell(*error);
    } else if (options_.goldens == Goldens::kUpdate) {
      update(scenarios_[k], played);
    } else {
      check(scenarios_[k], played);
    }
  }
  if (options_.goldens == Goldens::kUpdate && !write_registers()) return Exit::kUnusable;
  if (wrong_ != 0) return Exit::kDiffers;
  if (options_.output == Output::kVerdict) {
    out_ << "ok " << scenarios_.size() << " scenarios, " << hashes << " hashes,";
    for (const physics::InstructionSet set : instructions_) out_ << ' ' << physics::to_text(set);
    out_ << '\n';
  }
  return Exit::kSame;
}

}  // namespace woodlouse::scenario
