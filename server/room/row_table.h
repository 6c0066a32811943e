// Writes a louse's row as frames carry it: [id,x,y,...] in a layout's columns and format.
//
// Columns nobody asks for are not computed: height and attitude cost a sample of the terrain. A row is built
// on the stack and appended once.
#pragma once

#include <string>
#include <vector>

#include "shared/protocol/messages.h"
#include "shared/state/louse_fields.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

/// What the rows of a group of clients look like; clients of one layout share their frames.
struct RowLayout {
  std::vector<protocol::Column> fields;
  protocol::Format format = protocol::Format::kQuantized;
  friend auto operator<=>(const RowLayout&, const RowLayout&) = default;
};

class RowTable {
 public:
  /// REQUIRES at least one field, all of them distinct.
  explicit RowTable(RowLayout layout);

  void append(std::string& out, const state::Louse& louse, const terrain::Terrain& terrain) const;
  [[nodiscard]] const RowLayout& layout() const { return layout_; }

 private:
  RowLayout layout_;
  std::vector<const state::LouseField*> own_fields_;  ///< of layout_.fields; null: computed
  bool needs_ground_ = false;                         ///< a column is computed, from the terrain's sample
  bool needs_attitude_ = false;                       ///< one of them is an angle: three arc tangents
};

}  // namespace woodlouse::server
