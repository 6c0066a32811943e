// Turns the lice of a room into keys and deltas, once per (room, format, fields, tick).
//
//   key    {"type":"key","tick":n,"louse":[[...],...],"hash":"16 hex digits"}
//   delta  {"type":"delta","tick":n,"base":k,"louse":[[...],...],"gone":[id,...]}
// where there are rules of play both with "game":{...}, before the hash and at the end. A delta is cumulative
// against the last key: the rows whose text differs from the key's, and the ids that are in the key and no
// longer there. Cost: one comparison for a louse that is as in the key, else one row of text. Pure: no
// socket. The room's strand owns it.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/frames/frame.h"
#include "server/frames/row_table.h"
#include "shared/protocol/game.h"
#include "shared/rules/rules.h"
#include "shared/state/louse.h"
#include "shared/state/state_hash.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

/// What the rules of play show at one tick.
struct GameScene {
  protocol::Game game;
  std::vector<rules::Standing> standings;  ///< of the scene's lice, one each
};

/// What there is to see at one tick.
struct Scene {
  std::uint64_t tick = 0;
  std::uint64_t index = 0;             ///< of the frame (frame.h)
  std::span<const state::Louse> lice;  ///< ascending id
  const terrain::Terrain& terrain;
  std::uint64_t hash = 0;           ///< of the state at `tick`
  state::HashLink link;             ///< what went into the hash besides the lice
  std::optional<GameScene> game{};  ///< where there are rules
  bool wraps = false;               ///< beyond each edge of the map lies the opposite one

  /// Of lice[louse], by the rules of play.
  [[nodiscard]] rules::Standing standing(std::size_t louse) const {
    if (!game) return {};
    assert(game->standings.size() == lice.size());
    return game->standings[louse];
  }
};

/// The member `game` of a frame, after others.
void append_its_game(std::string& text, const protocol::Game& game);

class FrameEncoder {
 public:
  explicit FrameEncoder(RowLayout layout);

  Frame key(const Scene& scene);
  /// REQUIRES a key() before. Its base is the last key.
  Frame delta(const Scene& scene);
  [[nodiscard]] const RowLayout& layout() const { return rows_.layout(); }

 private:
  void write_key(std::string& text, const Scene& scene);
  void write_delta(std::string& text, const Scene& scene);

  struct KeyRow {
    state::Louse louse;
    rules::Standing standing;
    std::size_t begin = 0;  ///< of its text in key_text_
    std::size_t end = 0;
  };

  RowTable rows_;
  bool proves_hash_ = false;  ///< exact and `all`: keys carry what else went into the hash
  LinePool lines_;
  Line key_text_;
  std::uint64_t key_tick_ = 0;
  std::vector<KeyRow> key_rows_;
  std::optional<protocol::Game> key_game_;
  std::string row_;   ///< being compared with the key's
  std::string gone_;  ///< of the delta being written
};

}  // namespace woodlouse::server
