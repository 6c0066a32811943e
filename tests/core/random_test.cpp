#include "shared/core/random.h"

#include <catch2/catch.hpp>

using woodlouse::core::Random;

TEST_CASE("the generator is SplitMix64, by its published sequence for seed 1234567") {
  Random random(1234567);
  CHECK(random.next() == 6457827717110365317u);
  CHECK(random.next() == 3203168211198807973u);
  CHECK(random.next() == 9817491932198370423u);
}

TEST_CASE("uniform numbers lie in [0, 1) with the mean and variance of the uniform distribution") {
  Random random(7);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    REQUIRE((u >= 0.0 && u < 1.0));
    sum += u;
    squares += u * u;
  }
  CHECK(sum / kCount == Approx(0.5).margin(0.005));
  CHECK(squares / kCount == Approx(1.0 / 3.0).margin(0.005));
}
