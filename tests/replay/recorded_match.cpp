#include "tests/replay/recorded_match.h"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <sstream>

#include "shared/core/joined.h"
#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/replay/recorded_map_file.h"
#include "shared/replay/writer.h"

namespace woodlouse::replay {
namespace {

constexpr double kQuantum = 1.0 / 128.0;

/// Players that come, steer at random and go.
class RandomGame {
 public:
  RandomGame(const Scenario& scenario, Encoding encoding)
      : scenario_(scenario),
        random_(scenario.seed),
        match_(small_map(scenario.surface), {60, scenario.seed}),
        writer_(encoding) {}

  Recording play() {
    std::string& out = recording_.bytes;
    writer_.append_header(out, make_header(match_, "tests", "small.json"));
    writer_.append_keyframe(out, match_.state());
    for (std::uint64_t step = 0; step < scenario_.steps; ++step) {
      come_and_go();
      for (const match::PlayerId player : players_) {
        for (std::uint64_t n = random_.next() % 24; n < 2; ++n) steer(player);
      }
      if (scenario_.notes == Notes::kNamesAndMargins && random_.next() % 50 == 0) {
        writer_.append_chat(out, match_.tick(), 1, "louse", "hello \"you\"\t\xf0\x9f\x90\x9e");
      }
      const match::StepRecord& record = match_.advance();
      count(record);
      writer_.append_step(out, record);
      recording_.states.push_back(match_.state());
      if (match_.tick() % scenario_.keyframe_ticks == 0) writer_.append_keyframe(out, match_.state());
      if (step % 30 == 0) writer_.flush(out);
    }
    writer_.append_end(out, "steps done");
    return std::move(recording_);
  }

 private:
  void come_and_go() {
    const std::uint64_t choice = random_.next() % 40;
    if (choice < 2 || players_.size() < 3) {
      const bool is_named = scenario_.notes == Notes::kNamesAndMargins;
      const std::string name = is_named ? "louse " + std::to_string(++named_) : std::string();
      players_.push_back(match_.join({name, state::Role::kBot}));
    } else if (choice == 2) {
      const std::size_t index = random_.next() % players_.size();
      match_.leave(players_[index]);
      players_.erase(players_.begin() + static_cast<std::ptrdiff_t>(index));
    } else if (choice == 3) {
      match_.respawn(players_[random_.next() % players_.size()]);
    }
  }

  /// A multiple of 1/128 in [-1, 1]; minus zero now and then, as rounding makes it.
  double thrust() {
    const double value = (static_cast<double>(random_.next() % 257) - 128.0) * kQuantum;
    return value == 0.0 && random_.next() % 2 == 0 ? -0.0 : value;
  }

  void steer(match::PlayerId player) {
    match::Input input;
    input.player = player;
    input.seq = ++seq_[player];
    if (random_.next() % 2 == 0) {
      input.thrust = {state::ThrustKind::kAlongHeading, {thrust(), 0.0}};
    } else {
      input.thrust = {state::ThrustKind::kMapVector, {0.5 * thrust(), 0.5 * thrust()}};
    }
    if (random_.next() % 2 == 0) input.ticks = static_cast<std::uint32_t>(1 + random_.next() % 50);
    if (random_.next() % 3 == 0) input.wanted_tick = match_.tick() + random_.next() % 121;
    const match::Filed filed = match_.file(input);
    REQUIRE(filed.outcome == match::Filed::Outcome::kFiled);
    if (scenario_.notes == Notes::kNamesAndMargins) {
      writer_.note_margin(player, input.seq, static_cast<std::int64_t>(random_.next() % 20000) - 2000);
    }
  }

  void count(const match::StepRecord& record) {
    recording_.inputs += record.inputs.size();
    for (const match::AppliedInput& input : record.inputs) {
      std::uint32_t& highest = applied_[input.player];
      if (input.seq < highest) ++recording_.overtaken;
      highest = std::max(highest, input.seq);
    }
    for (const match::RosterChange& change : record.roster) {
      recording_.leaves += change.action == match::RosterAction::kLeave ? 1 : 0;
      recording_.respawns += change.action == match::RosterAction::kRespawn ? 1 : 0;
    }
  }

  const Scenario& scenario_;
  Recording recording_;
  core::Random random_;
  match::Match match_;
  ReplayWriter writer_;
  std::vector<match::PlayerId> players_;
  std::uint32_t named_ = 0;
  std::map<match::PlayerId, std::uint32_t> seq_;
  std::map<match::PlayerId, std::uint32_t> applied_;
};

}  // namespace

std::shared_ptr<const map::Map> small_map(const std::string& surface) {
  const std::string text =
      core::joined({R"({"name":"small","terrain":{"function":"wavy_pot","grid":6,"scale":10},"surface":")",
                    surface, R"("})"});
  const auto map = map::parse_map(text, "small.json", {});
  REQUIRE(map);
  return *map;
}

Recording record(const Scenario& scenario) {
  Recording recording = RandomGame(scenario, Encoding::kPlain).play();
  std::size_t begin = 0;
  for (std::size_t end = recording.bytes.find('\n'); end != std::string::npos;
       end = recording.bytes.find('\n', begin)) {
    recording.lines.push_back(recording.bytes.substr(begin, end + 1 - begin));
    begin = end + 1;
  }
  return recording;
}

Recording record_packed(const Scenario& scenario) { return RandomGame(scenario, Encoding::kZstd).play(); }

std::string Recording::text() const { return std::accumulate(lines.begin(), lines.end(), std::string()); }

std::string Recording::text_with_own_index() const {
  std::string text;
  for (const std::string& line : lines) {
    if (line.compare(0, 9, "{\"index\":") != 0 && line.compare(0, 7, "{\"end\":") != 0) text += line;
  }
  std::istringstream in(text);
  const auto index = scan_index(in, "r.jsonl");
  if (!index) FAIL(index.error().text());
  const std::uint64_t offset = text.size();
  append_index(text, *index);
  append_end(text, {index->last_tick, "steps done", offset});
  return text;
}

std::size_t Recording::line_of_step(std::uint64_t step) const {
  const std::string begin = core::joined({"{\"step\":", std::to_string(step), ","});
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].compare(0, begin.size(), begin) == 0) return k;
  }
  FAIL("no step " << step);
  return 0;
}

core::Expected<Verification> verify_text(const std::string& text, const std::filesystem::path& folder) {
  ReplaySource source = ReplaySource::of_bytes(text, "r.jsonl");
  source.find_map = [folder](const Header& header) { return load_named_map(header, {folder, {}}); };
  return verify(source);
}

std::shared_ptr<const ReplayArchive> opened(const std::string& bytes) {
  const auto archive = ReplayArchive::open(ReplaySource::of_bytes(bytes, "r.jsonl"));
  if (!archive) FAIL(archive.error().text());
  return *archive;
}

std::string state_text(const match::MatchState& state) {
  std::string text;
  append_keyframe(text, state);
  return text;
}

Verification verdict(const std::string& text) {
  const auto verification = verify_text(text);
  if (!verification) FAIL(verification.error().text());
  return *verification;
}

NumberPlace find_number(const std::string& line, const std::string& key, std::size_t from) {
  const std::size_t at = line.find(key, from);
  if (at == std::string::npos) return {};
  const std::size_t begin = line.find_first_of("-0123456789", at + key.size());
  return {begin, line.find_first_not_of("-+.e0123456789", begin)};
}

}  // namespace woodlouse::replay
