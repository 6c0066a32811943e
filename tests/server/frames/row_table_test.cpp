#include "server/frames/row_table.h"

#include <catch2/catch.hpp>

#include <memory>
#include <string>

#include "shared/protocol/codec.h"
#include "shared/terrain/shared_surface.h"
#include "tests/server/frames/scene.h"

using namespace woodlouse;
using namespace woodlouse::server;
using protocol::Column;
using protocol::Format;

namespace {

/// Counts who looks at it.
class CountingSurface final : public terrain::AbstractSurface {
 public:
  CountingSurface(const terrain::Terrain& terrain, int& samples) : terrain_(terrain), samples_(samples) {}
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const override {
    ++samples_;
    return terrain_.sample(x, y);
  }
  [[nodiscard]] terrain::Rectangle domain() const override { return terrain_.domain(); }
  [[nodiscard]] double cell() const override { return 1.0; }

 private:
  const terrain::Terrain& terrain_;
  int& samples_;
};

std::string expected_row(const std::vector<double>& values, const RowLayout& layout) {
  std::string row;
  for (std::size_t k = 0; k < values.size(); ++k) {
    char text[protocol::kValueRoom];
    const char* const end = protocol::write_value(text, values[k], layout.fields[k], layout.format);
    row += k == 0 ? '[' : ',';
    row.append(text, static_cast<std::size_t>(end - text));
  }
  return row + ']';
}

}  // namespace

TEST_CASE("every column, alone and beside any other, shows what it is defined as") {
  const test::Scenery scenery(3);
  for (const Format format : {Format::kQuantized, Format::kExact}) {
    for (std::size_t a = 0; a < protocol::kColumnCount; ++a) {
      for (std::size_t b = 0; b < protocol::kColumnCount; ++b) {
        RowLayout layout{{static_cast<Column>(a)}, format};
        if (b != a) layout.fields.push_back(static_cast<Column>(b));
        const RowTable rows(layout);
        for (const state::Louse& louse : scenery.lice) {
          std::string row;
          rows.append(row, louse, test::kStanding, scenery.terrain);
          REQUIRE(row ==
                  expected_row(test::values(louse, layout.fields, scenery.terrain, test::kStanding), layout));
        }
      }
    }
  }
}

TEST_CASE("the ground is looked at for those columns alone that need it, once a row") {
  const test::Scenery scenery(3);
  int samples = 0;
  const terrain::Terrain terrain{
      terrain::SharedSurface(std::make_shared<CountingSurface>(scenery.terrain, samples))};
  const auto looks = [&](const std::vector<Column>& columns, state::Phase phase) {
    const RowTable rows({columns, Format::kExact});
    state::Louse louse = scenery.lice[0];
    louse.phase = phase;
    samples = 0;
    std::string row;
    rows.append(row, louse, {}, terrain);
    return samples;
  };
  for (const auto phase : {state::Phase::kMoving, state::Phase::kResting, state::Phase::kFlying}) {
    CHECK(looks(protocol::all_columns(), phase) == 0);
    CHECK(looks({Column::kId, Column::kYaw}, phase) == 0);
    const int on_ground = phase == state::Phase::kFlying ? 0 : 1;
    CHECK(looks({Column::kZ}, phase) == on_ground);
    CHECK(looks({Column::kSpeed, Column::kYaw, Column::kZ}, phase) == on_ground);
    CHECK(looks({Column::kPitch}, phase) == 1);
    CHECK(looks({Column::kRoll}, phase) == 1);
    CHECK(looks({Column::kZ, Column::kRoll, Column::kPitch, Column::kSpeed}, phase) == 1);
  }
}
