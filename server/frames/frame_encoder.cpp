#include "server/frames/frame_encoder.h"

#include <cassert>
#include <cstring>
#include <utility>

#include "shared/json/object_text.h"
#include "shared/json/text.h"

namespace woodlouse::server {
namespace {

bool same_bytes(const state::Louse& a, const state::Louse& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// What besides the rows went into the hash.
void append_proof(std::string& text, const state::HashLink& link) {
  json::append_hash(text += R"(,"previous":)", link.previous);
  json::append_hash(text += R"(,"inputs":)", link.inputs);
  json::append_hash(text += R"(,"roster":)", link.roster);
  json::append_hash(text += R"(,"rules":)", link.rules);
  json::append_integer(text += R"(,"link":)", link.tick);
  json::append_hash(text += R"(,"generator":)", link.generator);
}

}  // namespace

void append_its_game(std::string& text, const protocol::Game& game) {
  json::ObjectText object(text += R"(,"game":)");
  protocol::append_game(object, game);
  object.end();
}

FrameEncoder::FrameEncoder(RowLayout layout) : rows_(std::move(layout)) {
  proves_hash_ =
      rows_.layout().format == protocol::Format::kExact && rows_.layout().fields == protocol::all_columns();
}

Frame FrameEncoder::key(const Scene& scene) {
  key_tick_ = scene.tick;
  key_text_ = lines_.line([&](std::string& text) { write_key(text, scene); });
  return {FrameKind::kKey, scene.tick, scene.tick, scene.index, key_text_};
}

void FrameEncoder::write_key(std::string& text, const Scene& scene) {
  json::append_integer(text += R"({"type":"key","tick":)", scene.tick);
  text += R"(,"louse":[)";
  key_rows_.clear();
  for (std::size_t k = 0; k < scene.lice.size(); ++k) {
    const state::Louse& louse = scene.lice[k];
    if (k > 0) text += ',';
    const std::size_t begin = text.size();
    const rules::Standing standing = scene.standing(k);
    rows_.append(text, louse, standing, scene.terrain);
    key_rows_.push_back({louse, standing, begin, text.size()});
  }
  text += ']';
  key_game_.reset();
  if (scene.game) {
    key_game_ = scene.game->game;
    append_its_game(text, *key_game_);
  }
  json::append_hash(text += R"(,"hash":)", scene.hash);
  if (proves_hash_) append_proof(text, scene.link);
  text += "}\n";
}

Frame FrameEncoder::delta(const Scene& scene) {
  assert(key_text_);
  return {FrameKind::kDelta, scene.tick, key_tick_, scene.index,
          lines_.line([&](std::string& text) { write_delta(text, scene); })};
}

void FrameEncoder::write_delta(std::string& text, const Scene& scene) {
  json::append_integer(text += R"({"type":"delta","tick":)", scene.tick);
  json::append_integer(text += R"(,"base":)", key_tick_);
  text += R"(,"louse":[)";
  gone_.clear();
  auto known = key_rows_.cbegin();
  const auto report_gone = [&] {
    if (!gone_.empty()) gone_ += ',';
    json::append_integer(gone_, known->louse.id);
    ++known;
  };
  bool first = true;
  for (std::size_t k = 0; k < scene.lice.size(); ++k) {
    const state::Louse& louse = scene.lice[k];
    const rules::Standing standing = scene.standing(k);
    while (known != key_rows_.cend() && known->louse.id < louse.id) report_gone();
    const bool is_known = known != key_rows_.cend() && known->louse.id == louse.id;
    if (is_known && same_bytes(known->louse, louse) && known->standing == standing) {
      ++known;
      continue;
    }
    row_.clear();
    rows_.append(row_, louse, standing, scene.terrain);
    if (is_known) {
      const KeyRow& row = *known++;
      if (std::string_view(*key_text_).substr(row.begin, row.end - row.begin) == row_) continue;
    }
    if (!std::exchange(first, false)) text += ',';
    text += row_;
  }
  while (known != key_rows_.cend()) report_gone();
  text += R"(],"gone":[)";
  text += gone_;
  text += ']';
  if (scene.game && key_game_) {
    const protocol::Game changed = protocol::difference(*key_game_, scene.game->game);
    if (!changed.empty()) append_its_game(text, changed);
  }
  text += "}\n";
}

}  // namespace woodlouse::server
