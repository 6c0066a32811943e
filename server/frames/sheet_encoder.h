// Turns the lice of a room into sheets of rows, once per (room, layout, tick), for clients that are each
// shown a part of them. Cost as of a frame_encoder: one comparison for a louse that is as in the key, else
// one row of text; and the grid. Pure: no socket. The outlet's strand owns it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/frames/frame.h"
#include "server/frames/frame_encoder.h"
#include "server/frames/row_table.h"

namespace woodlouse::server {

class SheetEncoder {
 public:
  /// REQUIRES a layout in sheets.
  explicit SheetEncoder(RowLayout layout);

  Frame key(const Scene& scene);
  /// REQUIRES a key() before. Its base is the last key.
  Frame delta(const Scene& scene);
  [[nodiscard]] const RowLayout& layout() const { return rows_.layout(); }

 private:
  /// What the text of a row was made of.
  struct Source {
    state::Louse louse;
    rules::Standing standing;
  };
  /// Of a louse that is as in the key: takes the key's text.
  [[nodiscard]] bool repeats_key(const Scene& scene, std::size_t louse, std::size_t key_row) const;
  void write_rows(RowSheet& sheet, const Scene& scene, bool is_key);
  void write_tail(const Scene& scene, bool is_key);

  RowTable rows_;
  SharedPool<RowSheet> sheets_;
  SharedRowSheet key_;
  std::uint64_t key_tick_ = 0;
  std::vector<Source> key_sources_;  ///< of the key's rows
  std::optional<protocol::Game> key_game_;
  std::string tail_;  ///< of the sheet being written
};

}  // namespace woodlouse::server
