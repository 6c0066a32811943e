// What one client is shown of a room's sheets: keys and deltas as of any client, of a part of the rows. A key
// holds the lice in view; a delta the rows of those in view that differ from the client's key or were not in
// it, and as gone the ids that were in the key and are not in view. So who comes into view or leaves it, and
// a view that is changed, needs no key. Pure. The session's lane owns it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "server/frames/frame.h"
#include "server/frames/line.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

class Viewer {
 public:
  /// own: the client's louse, which it is always shown; 0: a spectator. most: rows that the room allows.
  Viewer(const protocol::View& view, std::uint32_t own, std::size_t most);

  /// From the next frame on.
  void look(const protocol::View& view) { view_ = view; }
  /// A frame of a sheet as this client sees it. None: it rests on a key that the client was not shown.
  std::optional<Frame> frame(const Frame& frame);

 private:
  void find_rows(const RowSheet& sheet);
  [[nodiscard]] core::Vec2 middle(const RowSheet& sheet);
  void write_key(std::string& text, const Frame& frame) const;
  void write_delta(std::string& text, const Frame& frame) const;

  protocol::View view_;
  std::uint32_t own_;
  std::size_t most_;
  std::optional<core::Vec2> followed_;  ///< where the louse was seen last that is looked at
  std::uint64_t key_tick_ = 0;
  std::vector<std::uint32_t> key_ids_;  ///< ascending; what the client's key holds
  bool has_key_ = false;
  std::vector<RowSheet::Found> found_;  ///< of the frame being made
  LinePool lines_;
};

}  // namespace woodlouse::server
