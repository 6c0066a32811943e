#include "bench/scenario/golden_register.h"

#include <sstream>
#include <vector>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/core/whole_file.h"

namespace woodlouse::scenario {
namespace {

constexpr std::size_t kMaxHashFileBytes = 1u << 20;
constexpr std::string_view kHeader =
    "# behavior scenario script hashes; written by woodlouse-scenario run --update\n";

std::uint64_t digest_of_file(const Scenario& scenario) {
  std::vector<std::uint64_t> hashes;
  for (const GoldenHash& golden : scenario.goldens) hashes.push_back(golden.hash.value());
  return golden_digest(hashes);
}

}  // namespace

core::Expected<GoldenRegister> GoldenRegister::read(const std::filesystem::path& file) {
  const auto text = core::read_whole_file(file, kMaxHashFileBytes);
  if (!text) return tl::unexpected(text.error());
  GoldenRegister result;
  std::istringstream lines(*text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    Entry entry;
    std::string name;
    std::string rest;
    words >> std::dec >> entry.behavior >> name >> std::hex >> entry.script >> entry.hashes;
    if (!words || words >> rest || !result.entries_.emplace(name, entry).second) {
      return core::fail(core::joined({file.string(), ":", std::to_string(number)}),
                        "is no line of a register", "behavior scenario script hashes, each scenario once");
    }
  }
  return result;
}

std::optional<core::Error> GoldenRegister::forbids(const Scenario& scenario, int behavior,
                                                   std::uint64_t hashes) const {
  const auto found = entries_.find(scenario.name);
  if (found == entries_.end()) return std::nullopt;
  const Entry& entry = found->second;
  if (entry.behavior != behavior || entry.script != script_digest(scenario) || entry.hashes == hashes) {
    return std::nullopt;
  }
  return core::Error{
      core::joined({scenario.file.string(), ":", std::to_string(scenario.goldens_line), ": hashes"}),
      core::joined({"are not those registered for behavior ", std::to_string(behavior),
                    ": golden hashes change only together with the behavior"}),
      "if the change is wanted: raise match::kBehavior in shared/match/match.h, build, and run --update; "
      "if not: find what changed the bits"};
}

std::optional<core::Error> GoldenRegister::check(const Scenario& scenario) const {
  const auto found = entries_.find(scenario.name);
  const std::uint64_t hashes = digest_of_file(scenario);
  if (auto forbidden = forbids(scenario, scenario.behavior, hashes)) return forbidden;
  if (found != entries_.end() && found->second == Entry{scenario.behavior, script_digest(scenario), hashes}) {
    return std::nullopt;
  }
  return core::Error{scenario.file.string(),
                     found == entries_.end() ? core::joined({"is not in ", kRegisterName})
                                             : core::joined({"is not what ", kRegisterName,
                                                             " registers: its script has changed"}),
                     "woodlouse-scenario run --update registers it"};
}

void GoldenRegister::drop_missing(const std::filesystem::path& folder) {
  std::erase_if(entries_, [&](const auto& entry) {
    std::error_code error;
    return std::filesystem::status(folder / (entry.first + ".json"), error).type() ==
           std::filesystem::file_type::not_found;
  });
}

std::string GoldenRegister::text() const {
  std::string text(kHeader);
  for (const auto& [name, entry] : entries_) {
    text += core::joined({std::to_string(entry.behavior), " ", name, " ", core::to_hex(entry.script), " ",
                          core::to_hex(entry.hashes), "\n"});
  }
  return text;
}

}  // namespace woodlouse::scenario
