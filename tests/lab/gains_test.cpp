// That no force, contact or method makes energy, beyond what docs/physics.md states, where sub-steps are
// capped too: the short run of what `woodlouse-lab stability` measures.
#include "bench/lab/gains.h"

#include <catch2/catch.hpp>
#include <string>

using namespace woodlouse::lab;

TEST_CASE("no force, contact or method gains more energy than stated, at the sub-steps' cap too") {
  const Table table = gains(Effort::kQuick);
  REQUIRE(table.rows().size() == 3 * 3 * (10 + 7));
  int capped = 0;
  for (const auto& row : table.rows()) {
    const auto text = [&](std::size_t column) { return std::get<std::string>(row[column]); };
    const auto number = [&](std::size_t column) { return std::get<double>(row[column]); };
    INFO(text(0) << ", " << text(1) << ", " << text(2) << ", " << text(3));
    CHECK(number(4) <= number(6));
    capped += number(7) > 0.0 ? 1 : 0;
  }
  CHECK(capped > 30);
}
