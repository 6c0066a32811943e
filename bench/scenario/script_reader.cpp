#include "bench/scenario/script_reader.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/random.h"
#include "shared/match/input_queue.h"

namespace woodlouse::scenario {
namespace {

using json::Problems;

constexpr std::string_view kPlayerWants = "a player's number, a list of them, or \"all\"";
constexpr std::string_view kThrustWants =
    "a number from -1 to 1 (along the heading), a pair [x, y] of length at most 1 (map directions), null "
    "(none) or "
    "\"random\"";

enum class Whom { kListed, kAll };
enum class ThrustChoice { kGiven, kRandom };

/// One object of the script.
struct Rule {
  explicit Rule(const json::Value& value) : place(value) {}

  json::Value place;
  std::uint64_t at = 0;
  std::uint64_t every = 0;  ///< 0: once
  std::uint64_t until = 0;  ///< the last step it may be repeated in
  Event::Kind kind = Event::Kind::kInput;
  std::uint64_t joins = 0;
  Whom whom = Whom::kListed;
  std::vector<match::PlayerId> players;
  ThrustChoice choice = ThrustChoice::kGiven;
  state::Thrust thrust;
  std::uint32_t ticks = state::kHeld;
};

void read_players(const json::Value& value, Rule& rule, Problems& problems) {
  if (value.is(json::Kind::kString) && value.text() == "all") {
    rule.whom = Whom::kAll;
    return;
  }
  const std::vector<json::Value> numbers =
      value.is(json::Kind::kArray) ? value.children() : std::vector<json::Value>{value};
  for (const json::Value& number : numbers) {
    if (!number.is(json::Kind::kInteger))
      return problems.add(number, "names no player", std::string(kPlayerWants));
    const auto player = json::integer_in(number, 1, kMaxLice, problems);
    if (player) rule.players.push_back(static_cast<match::PlayerId>(*player));
  }
}

void read_thrust(const json::Value& value, Rule& rule, Problems& problems) {
  constexpr json::Range kUnit{-1.0, 1.0, {}};
  if (value.is(json::Kind::kNull)) return;
  if (value.is(json::Kind::kString) && value.text() == "random") {
    rule.choice = ThrustChoice::kRandom;
  } else if (value.is_number()) {
    const auto along = json::number_in(value, kUnit, problems);
    rule.thrust = {state::ThrustKind::kAlongHeading, {along.value_or(0.0), 0.0}};
  } else if (value.is(json::Kind::kArray)) {
    const auto pair = json::pair_in(value, kUnit, problems);
    if (pair && core::dot(*pair, *pair) > 1.0)
      problems.add(value, "is longer than 1", std::string(kThrustWants));
    rule.thrust = {state::ThrustKind::kMapVector, pair.value_or(core::Vec2{})};
  } else {
    problems.add(value, "is no thrust", std::string(kThrustWants));
  }
}

void read_action(const json::Value& value, const json::Fields& fields, Rule& rule, Problems& problems) {
  constexpr std::pair<std::string_view, Event::Kind> kActions[] = {{"join", Event::Kind::kJoin},
                                                                   {"leave", Event::Kind::kLeave},
                                                                   {"respawn", Event::Kind::kRespawn},
                                                                   {"player", Event::Kind::kInput}};
  int found = 0;
  for (const auto& [key, kind] : kActions) {
    const auto action = fields.find(key);
    if (!action) continue;
    ++found;
    rule.kind = kind;
    if (kind == Event::Kind::kJoin) {
      rule.joins = json::integer_in(*action, 1, kMaxLice, problems).value_or(0);
    } else {
      read_players(*action, rule, problems);
    }
  }
  if (found != 1) problems.add(value, "does not say one thing", "one of join, leave, respawn, player");
  const bool is_input = rule.kind == Event::Kind::kInput;
  for (const std::string_view key : {"thrust", "ticks"}) {
    const auto field = fields.find(key);
    if (field && !is_input) problems.add(*field, "belongs to an input, beside player");
  }
  if (!is_input) return;
  if (const auto thrust = fields.demand("thrust", kThrustWants)) read_thrust(*thrust, rule, problems);
  if (const auto ticks = fields.find("ticks")) {
    rule.ticks = static_cast<std::uint32_t>(json::integer_in(*ticks, 1, kMaxTicks, problems).value_or(1));
  }
}

Rule read_rule(const json::Value& value, std::uint64_t last_tick, Problems& problems) {
  Rule rule(value);
  const json::Fields fields(
      value, {"at", "every", "until", "join", "leave", "respawn", "player", "thrust", "ticks"}, problems);
  const std::uint64_t last_step = last_tick - 1;
  if (const auto at = fields.demand("at", "the step before which it happens")) {
    rule.at = json::integer_in(*at, 0, last_step, problems).value_or(0);
  }
  rule.until = last_step;
  if (const auto every = fields.find("every")) {
    rule.every = json::integer_in(*every, 1, kMaxTicks, problems).value_or(1);
  }
  if (const auto until = fields.find("until")) {
    rule.until = json::integer_in(*until, rule.at, last_step, problems).value_or(rule.at);
    if (rule.every == 0) problems.add(*until, "repeats nothing", "\"every\" says after how many steps");
  }
  read_action(value, fields, rule, problems);
  return rule;
}

/// Walks through the steps and turns rules into events.
class Layout {
 public:
  Layout(std::uint64_t seed, Problems& problems) : random_(seed), problems_(problems) {}

  void apply(const Rule& rule, std::uint64_t step) {
    if (is_full()) return;
    if (++occurrences_ > kMaxOccurrences) {
      return problems_.add(
          rule.place,
          core::joined({"the script's rules are due more than ", std::to_string(kMaxOccurrences), " times"}),
          "fewer rules, or \"every\" more steps");
    }
    if (rule.kind == Event::Kind::kJoin) {
      for (std::uint64_t k = 0; k < rule.joins; ++k) join(rule, step);
      return;
    }
    const std::vector<match::PlayerId> players =
        rule.whom == Whom::kAll ? std::vector<match::PlayerId>(present_.begin(), present_.end())
                                : rule.players;
    for (const match::PlayerId player : players) {
      if (!present_.contains(player)) {
        problems_.add(rule.place,
                      core::joined({"player ", std::to_string(player), " is not in the match at step ",
                                    std::to_string(step)}),
                      "players are numbered from 1 in the order they join");
        return;
      }
      if (is_full()) return;
      if (rule.kind == Event::Kind::kLeave) present_.erase(player);
      add(rule, step, player);
    }
  }

  std::vector<Event> events() && { return std::move(events_); }
  [[nodiscard]] bool is_full() const {
    return events_.size() >= kMaxEvents || occurrences_ > kMaxOccurrences;
  }

 private:
  void join(const Rule& rule, std::uint64_t step) {
    if (next_player_ > kMaxLice) {
      return problems_.add(rule.place, core::joined({"more than ", std::to_string(kMaxLice), " lice join"}));
    }
    present_.insert(next_player_);
    add(rule, step, next_player_);
    ++next_player_;
  }

  void add(const Rule& rule, std::uint64_t step, match::PlayerId player) {
    if (is_full()) return;
    Event event{step, rule.kind, player, rule.thrust, rule.ticks};
    if (rule.kind == Event::Kind::kInput) {
      if (rule.choice == ThrustChoice::kRandom) event.thrust = random_thrust();
      count_input(rule, step, player);
    }
    events_.push_back(event);
    if (is_full()) {
      problems_.add(rule.place,
                    core::joined({"the script has more than ", std::to_string(kMaxEvents), " events"}));
    }
  }

  /// Half of them along the heading, half map vectors, in the wire's quanta of 1/128.
  state::Thrust random_thrust() {
    const auto quanta = [this] { return (static_cast<double>(random_.next() % 257) - 128.0) * 0x1p-7; };
    const double first = quanta();
    if (random_.next() % 2 == 0) return {state::ThrustKind::kAlongHeading, {first, 0.0}};
    return {state::ThrustKind::kMapVector, {0.5 * first, 0.5 * quanta()}};
  }

  void count_input(const Rule& rule, std::uint64_t step, match::PlayerId player) {
    if (step != counted_step_) inputs_.clear();
    counted_step_ = step;
    if (++inputs_[player] == match::InputQueue::kMaxPending + 1) {
      problems_.add(rule.place, core::joined({"player ", std::to_string(player), " has more than ",
                                              std::to_string(match::InputQueue::kMaxPending),
                                              " inputs at step ", std::to_string(step)}));
    }
  }

  core::Random random_;
  Problems& problems_;
  std::vector<Event> events_;
  std::size_t occurrences_ = 0;
  std::set<match::PlayerId> present_;
  match::PlayerId next_player_ = 1;
  std::uint64_t counted_step_ = 0;
  std::map<match::PlayerId, std::size_t> inputs_;  ///< of counted_step_
};

}  // namespace

std::vector<Event> read_script(const json::Value& script, std::uint64_t last_tick, std::uint64_t seed,
                               Problems& problems) {
  if (!script.is(json::Kind::kArray)) {
    problems.add(script, "a list of what happens is wanted");
    return {};
  }
  std::vector<Rule> rules;
  for (const json::Value& value : script.children()) rules.push_back(read_rule(value, last_tick, problems));
  if (problems.count() != 0) return {};

  // By step, and within a step in the order of the file.
  std::multimap<std::uint64_t, const Rule*> due;
  for (const Rule& rule : rules) due.emplace(rule.at, &rule);
  Layout layout(seed, problems);
  for (std::uint64_t step = 0; !due.empty(); step = due.empty() ? step : due.begin()->first) {
    std::vector<const Rule*> now;
    for (auto [at, end] = due.equal_range(step); at != end; ++at) now.push_back(at->second);
    due.erase(step);
    std::sort(now.begin(), now.end());  // they lie in one vector, in the order of the file
    for (const Rule* rule : now) {
      layout.apply(*rule, step);
      const bool repeats = rule->every != 0 && rule->until - step >= rule->every;
      if (repeats && !layout.is_full() && problems.count() == 0) due.emplace(step + rule->every, rule);
    }
  }
  return std::move(layout).events();
}

}  // namespace woodlouse::scenario
