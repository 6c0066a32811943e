#include "bench/scenario/verdict.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/core/stable_hash.h"

namespace woodlouse::scenario {
namespace {

std::string at_tick(const Scenario& scenario, std::uint64_t tick) {
  return core::joined({"scenario ", scenario.name, ", tick ", std::to_string(tick), ": "});
}

/// The line of a tick's hash: --update writes one a line; a list on one line has them all there.
std::string golden_place(const Scenario& scenario, std::uint64_t tick) {
  const std::string key = core::joined({"\"", std::to_string(tick), "\""});
  const Span place = scenario.goldens_place;
  const std::string_view before = std::string_view(scenario.text)
                                      .substr(place.begin, place.size)
                                      .substr(0, scenario.text.find(key, place.begin) - place.begin);
  std::size_t line = scenario.goldens_line;
  for (const char c : before) line += c == '\n' ? 1 : 0;
  return core::joined({scenario.file.string(), ":", std::to_string(line), ": hashes.", std::to_string(tick)});
}

/// The first of what the rules said that is not as the file has it.
std::vector<core::Error> unlike_rulings(const Scenario& scenario, const Play& played) {
  if (!scenario.rulings || *scenario.rulings == played.rulings()) return {};
  const std::vector<std::string>& wanted = *scenario.rulings;
  std::size_t k = 0;
  while (k < wanted.size() && k < played.rulings().size() && wanted[k] == played.rulings()[k]) ++k;
  const auto at = [k](const std::vector<std::string>& rulings) {
    return k < rulings.size() ? core::joined({"\"", rulings[k], "\""}) : std::string("nothing");
  };
  return {core::Error{core::joined({scenario.file.string(), ": rulings"}),
                      core::joined({"scenario ", scenario.name, ", ruling ", std::to_string(k + 1), ": ",
                                    at(wanted), " expected, ", at(played.rulings()), " said"}),
                      "if that is wanted: woodlouse-scenario run --update"}};
}

}  // namespace

std::optional<core::Error> disagreement(std::span<const std::unique_ptr<Play>> plays) {
  const Play& first = *plays.front();
  const Scenario& scenario = first.scenario();
  for (const auto& other : plays) {
    const Play& play = *other;
    for (std::size_t k = 0; k < play.hashes().size(); ++k) {
      if (play.hashes()[k] == first.hashes()[k]) continue;
      return core::Error{
          scenario.file.string(),
          core::joined({at_tick(scenario, scenario.goldens[k].tick), "hash ", core::to_hex(first.hashes()[k]),
                        " by ", physics::to_text(first.instructions()), ", ", core::to_hex(play.hashes()[k]),
                        " by ", physics::to_text(play.instructions())}),
          "the same match gave two results in one program: this is a fault, whatever the file says"};
    }
  }
  return std::nullopt;
}

std::vector<core::Error> differences(const Scenario& scenario, const Play& played) {
  if (scenario.behavior != match::kBehavior) {
    return {core::Error{
        core::joined({scenario.file.string(), ": behavior"}),
        core::joined({std::to_string(scenario.behavior), " made these hashes, this program is of behavior ",
                      std::to_string(match::kBehavior)}),
        "if that is wanted: woodlouse-scenario run --update"}};
  }
  for (std::size_t k = 0; k < scenario.goldens.size(); ++k) {
    const GoldenHash& golden = scenario.goldens[k];
    const std::uint64_t hash = played.hashes()[k];
    if (golden.hash == hash) continue;
    const std::string place = golden_place(scenario, golden.tick);
    if (!golden.hash) {
      return {core::Error{place, core::joined({at_tick(scenario, golden.tick), "no hash is expected yet"}),
                          "woodlouse-scenario run --update fills it in"}};
    }
    return {core::Error{
        place,
        core::joined({at_tick(scenario, golden.tick), "hash ", core::to_hex(*golden.hash), " expected, ",
                      core::to_hex(hash), " played by ", physics::to_text(played.instructions())}),
        {}}};
  }
  return unlike_rulings(scenario, played);
}

std::string table_of(const Play& played) {
  std::string table;
  for (std::size_t k = 0; k < played.hashes().size(); ++k) {
    table += core::joined({core::printable(played.scenario().name), " ",
                           std::to_string(played.scenario().goldens[k].tick), " ",
                           core::to_hex(played.hashes()[k]), "\n"});
  }
  return table;
}

std::string updated_text(const Scenario& scenario, const Play& played) {
  std::string goldens = "{";
  for (std::size_t k = 0; k < played.hashes().size(); ++k) {
    goldens += core::joined({k == 0 ? "\n" : ",\n", "    \"", std::to_string(scenario.goldens[k].tick),
                             "\": \"", core::to_hex(played.hashes()[k]), "\""});
  }
  goldens += "\n  }";
  std::string rulings = "[";
  for (std::size_t k = 0; k < played.rulings().size(); ++k)
    rulings += core::joined({k == 0 ? "\n" : ",\n", "    \"", played.rulings()[k], "\""});
  rulings += played.rulings().empty() ? "]" : "\n  ]";
  std::vector<std::pair<Span, std::string>> parts = {
      {scenario.behavior_place, std::to_string(match::kBehavior)},
      {scenario.goldens_place, std::move(goldens)}};
  if (scenario.rulings) parts.emplace_back(scenario.rulings_place, std::move(rulings));
  // The last place first: the others then still are where they were.
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.first.begin > b.first.begin; });
  std::string text = scenario.text;
  for (const auto& [place, written] : parts) text.replace(place.begin, place.size, written);
  return text;
}

}  // namespace woodlouse::scenario
