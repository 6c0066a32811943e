// Writes a louse's row as frames carry it: [id,x,y,...] in a layout's columns and format.
//
// Columns nobody asks for are not computed, nor what they are computed from: a height costs a sample of the
// terrain, an angle an arc tangent. A row is built on the stack and appended once.
#pragma once

#include <string>
#include <vector>

#include "shared/protocol/messages.h"
#include "shared/rules/rules.h"
#include "shared/state/louse_fields.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

/// What the rows of a group of clients look like; clients of one layout share their frames.
struct RowLayout {
  std::vector<protocol::Column> fields;
  protocol::Format format = protocol::Format::kQuantized;
  bool in_sheets = false;  ///< each client is shown a part of the rows (row_sheet.h)
  friend auto operator<=>(const RowLayout&, const RowLayout&) = default;
};

class RowTable {
 public:
  /// REQUIRES at least one field, all of them distinct.
  explicit RowTable(RowLayout layout);

  /// standing: by the rules of play; where there are none, of zeros.
  void append(std::string& out, const state::Louse& louse, const rules::Standing& standing,
              const terrain::Terrain& terrain) const;
  [[nodiscard]] const RowLayout& layout() const { return layout_; }

 private:
  /// One column, as what writes it needs it.
  struct Cell {
    protocol::Column column;
    const state::LouseField* own = nullptr;  ///< of the louse; null: computed
    double per_quantum = 1.0;
  };
  /// When the ground under a louse is sampled.
  enum class Ground { kNever, kUnlessFlying, kAlways };

  template <typename Write>
  void append_cells(std::string& out, const state::Louse& louse, const rules::Standing& standing,
                    const terrain::Terrain& terrain, const Write& write) const;

  RowLayout layout_;
  std::vector<Cell> cells_;
  Ground ground_ = Ground::kNever;
  bool needs_pitch_ = false;
};

}  // namespace woodlouse::server
