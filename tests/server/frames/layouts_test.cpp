#include "server/frames/layouts.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace woodlouse;
using namespace woodlouse::server;
using protocol::Column;
using protocol::Format;

namespace {

const RowLayout kPlain{protocol::default_columns(), Format::kQuantized};
const RowLayout kExact{protocol::default_columns(), Format::kExact};

RowLayout rare(Column column, Format format = Format::kQuantized) { return {{Column::kId, column}, format}; }

}  // namespace

TEST_CASE("clients of one layout share a channel, which is new once and ends with the last of them") {
  Layouts layouts;
  const auto a = layouts.acquire(kPlain, 1, 4);
  const auto b = layouts.acquire(kPlain, 2, 4);
  const auto c = layouts.acquire(kExact, 1, 4);
  CHECK(a.is_new);
  CHECK_FALSE(b.is_new);
  CHECK(a.channel == b.channel);
  CHECK(a.channel != c.channel);
  CHECK_FALSE(layouts.release(a.channel));
  CHECK(layouts.release(b.channel));
  CHECK(layouts.release(c.channel));
  CHECK(layouts.empty());
  CHECK(layouts.acquire(kPlain, 1, 4).channel != a.channel);
}

TEST_CASE(
    "layouts are bounded, one more is served a wider one, and one that nobody uses any more makes room") {
  Layouts layouts;
  std::vector<ChannelId> ids;
  AddressId address = 0;  // each its own
  const auto acquire = [&](const RowLayout& layout) { return layouts.acquire(layout, ++address, 4).channel; };
  for (std::size_t i = 0; i < Layouts::kMostRare; ++i) {
    RowLayout layout{{Column::kId, Column::kPhase}, i % 2 ? Format::kExact : Format::kQuantized};
    for (std::size_t n = 0; n < i / 2; ++n) layout.fields.push_back(static_cast<Column>(1 + n));
    ids.push_back(acquire(layout));
    CHECK(layouts.layout(ids.back()) == layout);
  }
  // Whose columns a smaller and a larger one have; whose only every column has.
  const ChannelId wider = acquire(rare(Column::kVx, Format::kExact));
  CHECK(layouts.layout(wider).fields ==
        std::vector{Column::kId, Column::kPhase, Column::kX, Column::kY, Column::kVx});
  CHECK(layouts.layout(wider).format == Format::kExact);
  const RowLayout other{{Column::kId, Column::kSpeed, Column::kDistance}, Format::kExact};
  CHECK(layouts.layout(acquire(other)).fields.size() == protocol::kColumnCount);
  CHECK(layouts.layout(acquire(rare(Column::kDistance))).fields == protocol::all_columns());
  // The common ones are always there.
  for (const Format format : {Format::kExact, Format::kQuantized}) {
    for (const auto& fields : {protocol::default_columns(), protocol::all_columns()})
      CHECK(layouts.layout(acquire({fields, format})) == RowLayout{fields, format});
  }
  layouts.release(ids[3]);
  CHECK(layouts.layout(acquire(other)) == other);
}

TEST_CASE("an address has its share of rare layouts, shares those of others, and others have theirs") {
  Layouts layouts;
  const auto own = layouts.acquire(rare(Column::kX), 1, 2);
  layouts.acquire(rare(Column::kY), 1, 2);
  CHECK(layouts.layout(layouts.acquire(rare(Column::kVx), 1, 2).channel).fields == protocol::all_columns());
  CHECK(layouts.layout(layouts.acquire(rare(Column::kVx), 2, 2).channel) == rare(Column::kVx));
  CHECK(layouts.layout(layouts.acquire(rare(Column::kVx), 1, 2).channel) == rare(Column::kVx));
  CHECK(layouts.release(own.channel));
  CHECK(layouts.layout(layouts.acquire(rare(Column::kVy), 1, 2).channel) == rare(Column::kVy));
  CHECK(layouts.layout(layouts.acquire(rare(Column::kZ), 3, 0).channel).fields.size() > 2);
}
