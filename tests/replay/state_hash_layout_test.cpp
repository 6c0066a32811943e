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
    CHECK(keyframe->state.previous == previous);
    CHECK(keyframe->state.inputs == inputs_digest(step));
    CHECK(keyframe->state.generator == generator);
    Bytes bytes;
    bytes.u64(previous);
    bytes.u64(inputs_digest(step));
    bytes.u64(keyframe->state.tick);
    for (const state::Louse& louse : keyframe->state.lice) {
      for (const state::LouseField& field : state::kLouseFields) {
        const double value = state::field_value(louse, field);
        if (state::holds_integer(field)) {
          bytes.u32(static_cast<std::uint32_t>(value));
        } else {
          bytes.f64(value);
        }
      }
    }
    bytes.u64(generator);
    CHECK(bytes.hash() == step.hash);
    ++checked;
  }
  CHECK(checked == 300);
}

}  // namespace woodlouse::replay
