#include "bench/swarm/missed_frames.h"

#include <catch2/catch.hpp>

using woodlouse::swarm::missed_frames;

TEST_CASE("frames in their turn leave no hole") {
  CHECK(missed_frames(840, 843, 3) == 0);
  CHECK(missed_frames(0, 1, 1) == 0);
}

TEST_CASE("each frame that was due between two is missed") {
  CHECK(missed_frames(840, 846, 3) == 1);
  CHECK(missed_frames(840, 900, 3) == 19);
  CHECK(missed_frames(840, 842, 1) == 1);
}

TEST_CASE("a frame out of turn makes no hole") {
  CHECK(missed_frames(840, 841, 3) == 0);
  CHECK(missed_frames(841, 843, 3) == 0);
  CHECK(missed_frames(841, 846, 3) == 1);
}

TEST_CASE("a tick that is not after the former misses none, nor does a rate that nobody knows") {
  CHECK(missed_frames(843, 843, 3) == 0);
  CHECK(missed_frames(843, 840, 3) == 0);
  CHECK(missed_frames(840, 900, 0) == 0);
}
