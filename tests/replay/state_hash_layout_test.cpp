// docs/determinism.md says how a hash is made of what a recording holds; this does it, byte by byte.
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <sstream>
#include <string>

#include "shared/core/stable_hash.h"
#include "shared/replay/line_reader.h"
#include "shared/state/louse_fields.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

class Bytes {
 public:
  void u32(std::uint32_t value) {
    for (int k = 0; k < 4; ++k) bytes_ += static_cast<char>(value >> (8 * k));
  }
  void u64(std::uint64_t value) {
    for (int k = 0; k < 8; ++k) bytes_ += static_cast<char>(value >> (8 * k));
  }
  void f64(double value) { u64(std::bit_cast<std::uint64_t>(value)); }
  void text(const std::string& value) { bytes_ += value; }
  [[nodiscard]] std::uint64_t hash() const { return core::stable_hash(bytes_); }

 private:
  std::string bytes_;
};

std::uint64_t inputs_digest(const match::StepRecord& step) {
  Bytes bytes;
  for (const match::AppliedInput& input : step.inputs) {
    bytes.u32(input.player);
    bytes.u32(input.seq);
    bytes.f64(input.thrust.x);
    bytes.f64(input.thrust.y);
    bytes.u32(static_cast<std::uint32_t>(input.kind));
    bytes.u32(input.ticks);
    bytes.u64(step.tick);
  }
  return bytes.hash();
}

std::uint64_t roster_digest(const match::StepRecord& step) {
  Bytes bytes;
  for (const match::RosterChange& change : step.roster) {
    const bool is_join = change.action == match::RosterAction::kJoin;
    bytes.u32(is_join ? 1 : change.action == match::RosterAction::kLeave ? 2 : 3);
    bytes.u32(change.player);
    bytes.u32(is_join && change.label.role == state::Role::kBot ? 1 : 0);
    bytes.u32(is_join ? static_cast<std::uint32_t>(change.label.name.size()) : 0);
    if (is_join) bytes.text(change.label.name);
  }
  return bytes.hash();
}

}  // namespace

TEST_CASE("the hash of a keyframe's tick can be made again from the recording alone") {
  const Recording recording = record({.seed = 21, .steps = 300, .keyframe_ticks = 1});
  std::istringstream in(recording.text());
  ReplayReader reader(in, "r");
  const auto header = reader.read_header();
  REQUIRE(header);
  std::uint64_t generator = header->seed;
  std::uint64_t previous = 0;
  match::StepRecord step;
  std::size_t checked = 0;
  for (auto line = reader.next(); line && line->has_value(); line = reader.next()) {
    if (const auto* read = std::get_if<StepLine>(&**line)) {
      previous = step.hash;
      step = read->step;
      for (const match::RosterChange& change : step.roster) {
        if (change.action != match::RosterAction::kLeave) generator += 0x9E3779B97F4A7C15u;
      }
    }
    const auto* keyframe = std::get_if<Keyframe>(&**line);
    if (keyframe == nullptr || keyframe->state.tick == 0) continue;
    CHECK(keyframe->state.link.previous == previous);
    CHECK(keyframe->state.link.inputs == inputs_digest(step));
    CHECK(keyframe->state.link.roster == roster_digest(step));
    CHECK(keyframe->state.link.rules == 0);
    CHECK(keyframe->state.link.tick == keyframe->state.tick);
    CHECK(keyframe->state.link.generator == generator);
    REQUIRE(keyframe->state.lice.size() <= 64);  // one block
    Bytes block;
    for (const state::Louse& louse : keyframe->state.lice) {
      for (const state::LouseField& field : state::kLouseFields) {
        const double value = state::field_value(louse, field);
        if (state::holds_integer(field)) {
          block.u32(static_cast<std::uint32_t>(value));
        } else {
          block.f64(value);
        }
      }
    }
    Bytes bytes;
    bytes.u64(previous);
    bytes.u64(inputs_digest(step));
    bytes.u64(roster_digest(step));
    bytes.u64(0);
    bytes.u64(keyframe->state.tick);
    bytes.u64(generator);
    if (!keyframe->state.lice.empty()) bytes.u64(block.hash());
    CHECK(bytes.hash() == step.hash);
    ++checked;
  }
  CHECK(checked == 300);
}

}  // namespace woodlouse::replay
