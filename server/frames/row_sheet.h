// The rows of a room's lice at one tick, as text, and where they are: what is common to the frames of clients
// that are shown a part of them. Written once a layout and tick, then shared unchanged (viewer.h reads it).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/frames/shared_value.h"
#include "shared/core/vec2.h"

namespace woodlouse::server {

class RowSheet {
 public:
  struct Row {
    std::uint32_t id = 0;
    bool is_as_in_key = false;  ///< its text is that of the key that a delta rests on
    core::Vec2 place;           ///< [m]
    std::size_t begin = 0;      ///< of its text
    std::size_t end = 0;
  };
  /// A circle of the map: the rows nearest to its middle.
  struct Circle {
    core::Vec2 middle;  ///< [m]
    double radius = std::numeric_limits<double>::infinity();
    std::size_t most = std::numeric_limits<std::size_t>::max();  ///< rows
  };
  struct Found {
    std::size_t row = 0;
    double square = 0.0;  ///< of its distance [m^2]
  };
  /// Of equally near ones the lower id.
  static bool is_nearer(const Found& a, const Found& b) {
    return a.square != b.square ? a.square < b.square : a.row < b.row;
  }
  /// The map, and how far it is to the same place beyond its edges where these wrap (0, 0: they don't).
  struct Ground {
    core::Vec2 middle;
    core::Vec2 period;
  };

  // Written once:

  void begin(const Ground& ground);
  /// Where the next row's text is appended; then added(). Ids ascend.
  std::string& text() { return text_; }
  void added(const Row& row);
  /// All rows are there, and what stands behind them in each frame.
  void end(std::string_view tail);

  // Read on any thread:

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] std::string_view text(const Row& row) const {
    return std::string_view(text_).substr(row.begin, row.end - row.begin);
  }
  [[nodiscard]] std::string_view tail() const { return tail_; }
  [[nodiscard]] core::Vec2 middle() const { return ground_.middle; }
  /// The row of that louse.
  [[nodiscard]] std::optional<std::size_t> find(std::uint32_t id) const;
  /// Puts into `found`, whose memory is used again, the rows within the circle, by ascending id; of equally
  /// near ones at its limit the lower ids.
  void within(const Circle& circle, std::vector<Found>& found) const;

 private:
  struct Span {
    std::size_t first = 0, end = 0;
  };
  [[nodiscard]] Span cells_between(double low, double high, double origin, double cell) const;
  void search(core::Vec2 middle, double radius, std::vector<Found>& found) const;
  void search_image(core::Vec2 middle, double radius, std::vector<Found>& found) const;

  Ground ground_;
  std::string text_, tail_;
  std::vector<Row> rows_;
  // The rectangle that the lice are in is cut into side_ x side_ cells.
  std::size_t side_ = 1;
  core::Vec2 low_, high_, cell_;
  std::vector<std::size_t> cell_ends_;  ///< of each cell's part of by_cell_
  std::vector<std::size_t> by_cell_;    ///< rows
  std::vector<std::size_t> next_;       ///< while by_cell_ is filled
};

using SharedRowSheet = SharedValue<RowSheet>;

}  // namespace woodlouse::server
