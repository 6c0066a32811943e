#include "shared/core/root.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace woodlouse::core;

namespace {

struct Found {
  double time;
  int calls;
};

template <typename Function>
Found find(double low, double high, const Function& f) {
  Found found{0.0, 0};
  found.time = end_of_positive(low, f(low), high, f(high), [&](double t) {
    ++found.calls;
    return f(t);
  });
  return found;
}

}  // namespace

TEST_CASE("a smooth function's root is found to rounding in about eight calls") {
  const Found cosine = find(0.0, 2.0, [](double t) { return std::cos(t) - 0.3; });
  CHECK(std::fabs(cosine.time - std::acos(0.3)) < 1e-14);
  CHECK(cosine.calls <= 10);
  const Found cubic = find(-1.0, 1.0, [](double t) { return 0.5 - t * t * t; });
  CHECK(std::fabs(cubic.time - std::cbrt(0.5)) < 1e-14);
  CHECK(cubic.calls <= 14);
}

TEST_CASE("roots at either end, jumps and steep falls are found, never in more than 60 calls") {
  const auto check = [](double root, const auto& f) {
    const Found found = find(0.0, 1.0, f);
    INFO("root " << root << ", found " << found.time << " in " << found.calls);
    CHECK(found.time >= root);
    CHECK(found.time - root <= 0x1p-47);
    CHECK(!(f(found.time) > 0.0));
    CHECK(found.calls <= 60);
  };
  check(1e-9, [](double t) { return 1e-9 - t; });
  check(1.0, [](double t) { return 1.0 - t; });
  check(0.3, [](double t) { return t < 0.3 ? 1.0 : -1.0; });
  check(0.3, [](double t) { return t < 0.3 ? 1e-300 : -1e300; });
}

TEST_CASE("where the function is no number behind its root, the interval's end is taken") {
  CHECK(find(0.0, 1.0, [](double t) { return t < 1.0 ? 1.0 : std::nan(""); }).time == 1.0);
}
