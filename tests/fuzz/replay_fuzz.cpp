// Recordings, plain or compressed: each line reads back the same once written anew or is refused with its
// place; the archive opens, plays to its end and jumps, or says why not; and a keyframe that was altered, but
// whose hash was made to fit, is refused or can be gone on from; it can be inspected, forked and viewed. What
// is read from the front without a fault is what jumps find. A line can stand for 5000 steps: what would be
// re-run for longer than its bytes promise is only scanned.
//
// Input: the file; or 'P', a number of lies, each of 3 bytes, and a text that is packed into frames with a
// table of them that lies so (a fuzzer makes no frames whose checksums hold).
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "client/watch/recording_view.h"
#include "shared/core/error.h"
#include "shared/core/stable_hash.h"
#include "shared/replay/archive.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/inspect.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/line_writer.h"
#include "shared/replay/rerun.h"
#include "shared/replay/source.h"
#include "shared/replay/zstd_table.h"
#include "shared/state/state_hash.h"
#include "tests/fuzz/map_size.h"
#include "tests/fuzz/property.h"

using namespace woodlouse;
using namespace woodlouse::replay;
using fuzz::demand;
using fuzz::demand_readable;

namespace {

const std::string kSource = "r.ndjson";

void check(const core::Error& error) {
  demand(error.where.starts_with(kSource), "an error names its place", error.text());
  demand_readable(error.text());
}

// ---- lines -----------------------------------------------------------------------------------------------

std::string text_of(const Header& header) {
  std::string out;
  append_header(out, header);
  return out;
}

/// Of an index nothing: the reader keeps its tick alone.
struct LineText {
  std::string operator()(const StepLine& line) const {
    std::string out;
    if (line.steps > 1) {
      append_quiet_steps(out, line.step.tick, line.steps, line.step.hash);
      return out;
    }
    Margins margins;
    for (std::size_t k = 0; k < line.margins_ms.size(); ++k) {
      const match::AppliedInput& input = line.step.inputs[k];
      if (line.margins_ms[k]) margins[{input.player, input.seq}] = *line.margins_ms[k];
    }
    append_step(out, line.step, margins);
    return out;
  }
  std::string operator()(const Keyframe& line) const {
    std::string out;
    append_keyframe(out, line.state);
    return out;
  }
  std::string operator()(const ChatLine& line) const {
    std::string out;
    append_chat(out, line);
    return out;
  }
  std::string operator()(const PauseLine& line) const {
    std::string out;
    append_pause(out, line);
    return out;
  }
  std::string operator()(const IndexLine&) const { return {}; }
  std::string operator()(const End& line) const {
    std::string out;
    append_end(out, line);
    return out;
  }
};

std::string text_of(const Line& line) { return std::visit(LineText{}, line); }

void check_round_trip(const Header& header) {
  const std::string text = text_of(header);
  std::istringstream in(text);
  const auto again = ReplayReader(in, "written").read_header();
  demand(again.has_value(), "a header that is written can be read", text);
  demand(text_of(*again) == text, "a header reads back the same", text);
}

void check_round_trip(const Line& line) {
  const std::string text = text_of(line);
  if (text.empty()) return;
  demand(text.find('\n') == text.size() - 1, "a line is one line", text);
  std::istringstream in(text);
  const auto again = ReplayReader(in, "written").next_line();
  demand(again && *again, "what is written can be read", again ? text : again.error().text());
  demand((*again)->index() == line.index(), "a line reads back as its kind", text);
  demand(text_of(**again) == text, "a line reads back the same", text);
  if (const auto* step = std::get_if<StepLine>(&line)) {
    const auto& [other, margins, steps] = std::get<StepLine>(**again);
    demand(step->step.roster == other.roster && step->step.inputs == other.inputs && step->steps == steps,
           "a step reads back the same", text);
  }
}

// ---- keyframes -------------------------------------------------------------------------------------------

void check_finite(const match::Match& match) {
  for (const state::Louse& louse : match.world().lice()) {
    for (const double value :
         {louse.position.x, louse.position.y, louse.velocity.x, louse.velocity.y, louse.heading.x,
          louse.heading.y, louse.flight_z, louse.flight_vz, louse.distance}) {
      demand(std::isfinite(value), "a louse's state stays finite");
    }
  }
}

/// Whoever alters a keyframe can make its hash fit: what passes then must be a state that goes on.
void check_keyframe(const Header& header, const std::shared_ptr<const map::Map>& map, Keyframe keyframe) {
  const match::MatchSettings settings = replay::settings_of(header);
  match::MatchState& state = keyframe.state;
  if (state.link.tick != 0) {
    core::StableHasher hasher;
    state.hash = state::state_hash(hasher, state.link, state.lice);
  }
  const std::vector<match::PlayerSeq> players = state.players;
  const auto rerun = Rerun::from(map, settings, std::move(keyframe), kSource + ":2");
  if (!rerun) return check(rerun.error());
  constexpr int kSteps = 3;
  for (int k = 0; k < kSteps; ++k) {
    StepLine line;
    line.step.tick = (*rerun)->match().tick();
    for (const match::PlayerSeq& player : players) {
      match::AppliedInput input;
      input.tick = line.step.tick;
      input.player = player.player;
      input.kind = state::ThrustKind::kMapVector;
      input.thrust = {0.5, -0.5};
      input.ticks = 2;
      line.step.inputs.push_back(input);
    }
    const auto went = (*rerun)->step(line, kSource + ":3");
    if (!went) return check(went.error());
    check_finite((*rerun)->match());
  }
}

// ---- the whole file --------------------------------------------------------------------------------------

/// To be re-run: as many as a file of the length that the fuzzer is given has lines.
constexpr std::uint64_t kMostSteps = 1000;

/// False where a re-run would take another file, a map that takes long to build, or long.
bool check_lines(const ReplaySource& source) {
  const auto stream = source.open();
  if (!stream) {
    check(stream.error());
    return false;
  }
  ReplayReader reader(**stream, source.name);
  const auto header = reader.read_header();
  if (!header) {
    check(header.error());
    return false;
  }
  check_round_trip(*header);
  const bool is_quick = !header->map_definition.empty() && fuzz::is_quick_map(header->map_definition);
  std::shared_ptr<const map::Map> map;
  if (is_quick) map = recorded_map(*header, source).value_or(nullptr);
  std::uint64_t steps = 0;
  for (;;) {
    const auto line = reader.next_line();
    if (!line) {
      check(line.error());
      break;
    }
    if (!*line) break;
    check_round_trip(**line);
    if (const auto* step = std::get_if<StepLine>(&**line)) steps += step->steps;
    const auto* keyframe = std::get_if<Keyframe>(&**line);
    if (keyframe != nullptr && map != nullptr) check_keyframe(*header, map, *keyframe);
  }
  return is_quick && steps <= kMostSteps;
}

void check_playback(Playback& playback, const ReplayArchive& archive) {
  for (;;) {
    const auto step = playback.advance();
    if (!step) return check(step.error());
    if (!*step) break;
    demand(playback.tick() <= archive.last_tick(), "a recording ends at its last tick");
  }
  for (const std::uint64_t tick :
       {archive.last_tick(), archive.first_tick() + (archive.last_tick() - archive.first_tick()) / 2}) {
    const auto sought = playback.seek(tick);
    if (!sought) return check(sought.error());
    demand(playback.tick() == tick, "a jump ends where it was to");
  }
}

std::uint64_t middle_of(const ReplayArchive& archive) {
  return archive.first_tick() + (archive.last_tick() - archive.first_tick()) / 2;
}

void check_inspection(const ReplayArchive& archive) {
  const auto summary = inspect_summary(archive);
  if (!summary) {
    check(summary.error());
  } else {
    std::istringstream lines(*summary);
    for (std::string line; std::getline(lines, line);)
      demand(fuzz::is_plain_line(line), "a summary is lines of plain text", line);
  }
  for (const std::uint64_t tick : {archive.first_tick(), middle_of(archive), archive.last_tick()}) {
    const auto state = inspect_state(archive, tick);
    if (!state) return check(state.error());
    demand(state->json.find('\n') == state->json.size() - 1, "an inspected state is one line", state->json);
  }
}

/// What `fork` goes on from: the match at a tick, restored anew.
void check_fork(const ReplayArchive& archive) {
  const auto playback = archive.play(middle_of(archive));
  if (!playback) return check(playback.error());
  const match::Match& recorded = (*playback)->match();
  const match::MatchState state = recorded.state();
  if (!state.roster.empty()) return;
  const auto fork = match::Match::restore(archive.map(), recorded.settings(), state);
  const match::PlayerId newcomer = fork->join();
  for (int k = 0; k < 3; ++k) fork->advance();
  demand(fork->contains(newcomer), "whoever joins a fork is in it");
  check_finite(*fork);
}

/// What the viewer shows and proves.
void check_view(const ReplaySource& source) {
  const auto view = client::RecordingView::open(source);
  if (!view) return check(view.error());
  const ReplayArchive& archive = (*view)->archive();
  for (const std::uint64_t tick : {archive.last_tick(), middle_of(archive), archive.first_tick()}) {
    if (const auto shown = (*view)->show(tick); !shown) return check(shown.error());
    demand((*view)->chat().size() < 1000, "the viewer keeps a screen's worth of chat");
  }
  (*view)->prove(core::Time::max());
  demand((*view)->proof().proven() <= (*view)->proof().total(), "no more is proven than there is");
}

void check_archive(const ReplaySource& source) {
  const auto archive = ReplayArchive::open(source);
  if (!archive) return check(archive.error());
  demand((*archive)->first_tick() <= (*archive)->last_tick(), "a recording does not end before it begins");
  const auto playback = (*archive)->play((*archive)->first_tick());
  if (!playback) return check(playback.error());
  check_playback(**playback, **archive);
  check_inspection(**archive);
  check_fork(**archive);
  check_view(source);
}

// ---- packed ----------------------------------------------------------------------------------------------

std::string read_to_end(std::istream& in) { return {std::istreambuf_iterator<char>(in.rdbuf()), {}}; }

/// Jumps find what reading from the front finds, if that meets no fault.
void check_jumps(const ReplaySource& source) {
  const auto front = source.open();
  const auto jumping = source.open();
  if (!front || !jumping) return;
  const std::string text = read_to_end(**front);
  if (!fault_of(**front).empty()) return;
  (*jumping)->seekg(0, std::ios::end);
  demand(static_cast<std::size_t>((*jumping)->tellg()) == text.size(), "a text is as long as it is");
  for (const std::size_t at :
       {text.size() / 2, text.size() / 5, text.size() - text.size() / 5, std::size_t{0}}) {
    (*jumping)->clear();
    (*jumping)->seekg(static_cast<std::streamoff>(at));
    demand(read_to_end(**jumping) == text.substr(at), "a jump finds what stands there");
    demand(fault_of(**jumping).empty(), "a jump meets no fault in a text that has none", fault_of(**jumping));
  }
}

std::string packed_frame(std::string_view text) {
  std::string frame(ZSTD_compressBound(text.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), text.data(), text.size(), 1));
  return frame;
}

/// One frame a keyframe, as a server packs, and a table with those lies: which entry, what of it, by how
/// much.
std::string packed_with_lies(std::string_view input) {
  const std::size_t lies = input.empty() ? 0 : static_cast<unsigned char>(input.front()) % 8;
  input.remove_prefix(std::min<std::size_t>(input.size(), 1));
  const std::string_view table = input.substr(0, 3 * lies);
  input.remove_prefix(table.size());
  std::string file;
  std::vector<ZstdFrameSize> sizes;
  while (!input.empty()) {
    const std::size_t next = input.find("{\"keyframe\"", 1);
    const std::string_view part = input.substr(0, next);
    const std::string frame = packed_frame(part);
    file += frame;
    sizes.push_back({static_cast<std::uint32_t>(frame.size()), static_cast<std::uint32_t>(part.size())});
    input.remove_prefix(part.size());
  }
  for (std::size_t at = 0; at + 3 <= table.size() && !sizes.empty(); at += 3) {
    ZstdFrameSize& size = sizes[static_cast<unsigned char>(table[at]) % sizes.size()];
    std::uint32_t& lie = table[at + 1] % 2 == 0 ? size.packed : size.unpacked;
    lie += static_cast<std::uint32_t>(static_cast<signed char>(table[at + 2]));
  }
  append_zstd_table(file, sizes);
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string file(reinterpret_cast<const char*>(data), size);
  if (file.starts_with('P')) file = packed_with_lies(std::string_view(file).substr(1));
  const ReplaySource source = ReplaySource::of_bytes(std::move(file), kSource);
  check_jumps(source);
  if (check_lines(source)) check_archive(source);
  return 0;
}
