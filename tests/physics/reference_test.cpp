// The step against trajectories integrated to 1e-13 by an independent program (tests/reference).
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "shared/terrain/function_surface.h"
#include "tests/support/csv.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::FunctionSurface;

namespace {

/// The distance in the map plane between the step's answer and the table's, for one row.
double trajectory_error(const tests::CsvTable& t, std::size_t row, double rate) {
  const FunctionSurface surface(*terrain::function_from_text(t.text(row, "surface")), 1.0);
  state::Parameters p;
  p.drag = t.number(row, "drag");
  p.friction = t.number(row, "mu");
  p.thrust_max = 1.0;
  state::Louse louse =
      tests::moving({t.number(row, "x0"), t.number(row, "y0")}, {t.number(row, "vx0"), t.number(row, "vy0")});
  louse.thrust = {t.number(row, "thrust_x"), t.number(row, "thrust_y")};
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust_ticks = state::kHeld;
  const long ticks = std::lround(t.number(row, "t") * rate);
  const state::Louse end = tests::run<Forces<true, true, true>>(surface, p, louse, rate, ticks).louse;
  return std::hypot(end.position.x - t.number(row, "x"), end.position.y - t.number(row, "y"));
}

}  // namespace

TEST_CASE("trajectories with drag, friction and thrust meet the reference to 3e-7 at 120 Hz") {
  const tests::CsvTable table = tests::read_reference("exact_trajectories.csv");
  REQUIRE(table.rows.size() == 72);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    INFO("row " << row);
    CHECK(trajectory_error(table, row, 120.0) < 3e-7);
  }
}

TEST_CASE("rest positions under friction meet the reference to 3e-7 at 60 Hz") {
  const tests::CsvTable table = tests::read_reference("stops.csv");
  REQUIRE(table.rows.size() == 24);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const FunctionSurface surface(*terrain::function_from_text(table.text(row, "surface")), 1.0);
    state::Parameters p;
    p.drag = table.number(row, "drag");
    p.friction = table.number(row, "mu");
    const state::Louse louse = tests::moving({table.number(row, "x0"), table.number(row, "y0")},
                                             {table.number(row, "vx0"), table.number(row, "vy0")});
    const auto end = tests::run<Forces<true, true, false>>(surface, p, louse, 60.0, 60 * 60);
    const double error = std::hypot(end.louse.position.x - table.number(row, "x_rest"),
                                    end.louse.position.y - table.number(row, "y_rest"));
    INFO("row " << row);
    CHECK(end.louse.phase == state::Phase::kResting);
    CHECK(error < 3e-7);
  }
}
