#include "client/watch/recording_proof.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <set>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

/// The step that leads to that tick, as recorded; `rerun`: what it gave here.
replay::PlayedStep step_to(std::uint64_t tick, std::uint64_t rerun = 7) {
  replay::PlayedStep step;
  step.recorded.step.tick = tick - 1;
  step.recorded.step.hash = 7;
  step.hash = rerun;
  return step;
}

}  // namespace

TEST_CASE("each tick of a recording is proven once, in whatever order it was looked at") {
  constexpr std::uint64_t kFirst = 100;
  constexpr std::uint64_t kLast = 160;
  core::Random random(3);
  for (int game = 0; game < 50; ++game) {
    RecordingProof proof(kFirst, kLast);
    CHECK(proof.total() == kLast - kFirst);
    std::set<std::uint64_t> proven;
    for (int jump = 0; jump < 12; ++jump) {
      std::uint64_t tick = kFirst - 2 + random.next() % (kLast - kFirst + 4);
      for (std::uint64_t n = random.next() % 20; n > 0; --n, ++tick) {
        proof.take(step_to(tick));
        if (tick > kFirst && tick <= kLast) proven.insert(tick);
        REQUIRE(proof.proven() == proven.size());
      }
    }
    for (std::uint64_t tick = kFirst + 1; tick <= kLast; ++tick) proof.take(step_to(tick));
    CHECK(proof.proven() == proof.total());
    CHECK_FALSE(proof.difference());
  }
}

TEST_CASE("the earliest tick that differs is told, and is not proven") {
  RecordingProof proof(0, std::uint64_t{1} << 53);  // what a recording claims costs nothing
  proof.take(step_to(9, 8));
  proof.take(step_to(5, 8));
  proof.take(step_to(6));
  REQUIRE(proof.difference());
  CHECK(proof.difference()->tick == 5);
  CHECK(proof.proven() == 1);
}
