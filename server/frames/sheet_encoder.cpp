#include "server/frames/sheet_encoder.h"

#include <cassert>
#include <cstring>
#include <utility>

#include "shared/json/text.h"

namespace woodlouse::server {
namespace {

RowSheet::Ground ground_of(const Scene& scene) {
  const terrain::Rectangle& domain = scene.terrain.domain();
  const core::Vec2 low{domain.x_min, domain.y_min}, high{domain.x_max, domain.y_max};
  return {0.5 * (low + high), scene.wraps ? high - low : core::Vec2{}};
}

}  // namespace

SheetEncoder::SheetEncoder(RowLayout layout) : rows_(std::move(layout)) { assert(rows_.layout().in_sheets); }

Frame SheetEncoder::key(const Scene& scene) {
  key_tick_ = scene.tick;
  key_game_.reset();
  if (scene.game) key_game_ = scene.game->game;
  key_.reset();
  key_ = sheets_.make([&](RowSheet& sheet) { write_rows(sheet, scene, true); },
                      [](const RowSheet&) { return true; });
  return {FrameKind::kKey, scene.tick, scene.tick, scene.index, {}, key_};
}

Frame SheetEncoder::delta(const Scene& scene) {
  assert(key_);
  return {FrameKind::kDelta,
          scene.tick,
          key_tick_,
          scene.index,
          {},
          sheets_.make([&](RowSheet& sheet) { write_rows(sheet, scene, false); },
                       [](const RowSheet&) { return true; })};
}

bool SheetEncoder::repeats_key(const Scene& scene, std::size_t louse, std::size_t key_row) const {
  const Source& source = key_sources_[key_row];
  assert(source.louse.id == scene.lice[louse].id);
  return std::memcmp(&source.louse, &scene.lice[louse], sizeof source.louse) == 0 &&
         source.standing == scene.standing(louse);
}

void SheetEncoder::write_rows(RowSheet& sheet, const Scene& scene, bool is_key) {
  sheet.begin(ground_of(scene));
  if (is_key) key_sources_.clear();
  std::size_t known = 0;  // of the key's rows
  for (std::size_t k = 0; k < scene.lice.size(); ++k) {
    const state::Louse& louse = scene.lice[k];
    std::string& text = sheet.text();
    RowSheet::Row row{louse.id, false, louse.position, text.size(), 0};
    if (is_key) key_sources_.push_back({louse, scene.standing(k)});
    while (!is_key && known < key_sources_.size() && key_sources_[known].louse.id < louse.id) ++known;
    const bool is_known = !is_key && known < key_sources_.size() && key_sources_[known].louse.id == louse.id;
    if (is_known && repeats_key(scene, k, known)) {
      text += key_->text(key_->rows()[known]);
      row.is_as_in_key = true;
    } else {
      rows_.append(text, louse, scene.standing(k), scene.terrain);
    }
    row.end = text.size();
    if (is_known && !row.is_as_in_key) row.is_as_in_key = sheet.text(row) == key_->text(key_->rows()[known]);
    sheet.added(row);
  }
  write_tail(scene, is_key);
  sheet.end(tail_);
}

void SheetEncoder::write_tail(const Scene& scene, bool is_key) {
  tail_.clear();
  if (is_key) {
    if (key_game_) append_its_game(tail_, *key_game_);
    json::append_hash(tail_ += R"(,"hash":)", scene.hash);
  } else if (scene.game && key_game_) {
    const protocol::Game changed = protocol::difference(*key_game_, scene.game->game);
    if (!changed.empty()) append_its_game(tail_, changed);
  }
  tail_ += "}\n";
}

}  // namespace woodlouse::server
