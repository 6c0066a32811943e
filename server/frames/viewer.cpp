#include "server/frames/viewer.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

#include "shared/json/text.h"

namespace woodlouse::server {

Viewer::Viewer(const protocol::View& view, std::uint32_t own, std::size_t most)
    : view_(view), own_(own), most_(most) {
  assert(most_ > 0 && (!view.radius || *view.radius > 0.0));
}

std::optional<Frame> Viewer::frame(const Frame& frame) {
  assert(frame.sheet);
  const bool is_key = frame.kind == FrameKind::kKey;
  if (!is_key && (!has_key_ || frame.base != key_tick_)) return std::nullopt;
  find_rows(*frame.sheet);
  Frame shown{frame.kind, frame.tick, frame.base, frame.index, {}, {}};
  shown.text = lines_.line([&](std::string& text) {
    if (is_key)
      write_key(text, frame);
    else
      write_delta(text, frame);
  });
  if (is_key) {
    has_key_ = true;
    key_tick_ = frame.tick;
    key_ids_.clear();
    for (const RowSheet::Found& found : found_) key_ids_.push_back(frame.sheet->rows()[found.row].id);
  }
  return shown;
}

core::Vec2 Viewer::middle(const RowSheet& sheet) {
  if (view_.place) return *view_.place;
  if (const auto row = sheet.find(view_.louse.value_or(own_))) followed_ = sheet.rows()[*row].place;
  return followed_.value_or(sheet.middle());
}

void Viewer::find_rows(const RowSheet& sheet) {
  RowSheet::Circle circle{middle(sheet)};
  if (view_.radius) circle.radius = *view_.radius;
  circle.most = std::min<std::size_t>(view_.rows.value_or(protocol::kEveryRow), most_);
  sheet.within(circle, found_);
  const auto own = sheet.find(own_);
  if (!own) return;
  const auto at =
      std::lower_bound(found_.begin(), found_.end(), *own,
                       [](const RowSheet::Found& found, std::size_t row) { return found.row < row; });
  if (at != found_.end() && at->row == *own) return;
  found_.insert(at, {*own, -1.0});
  if (found_.size() <= circle.most) return;
  found_.erase(std::max_element(found_.begin(), found_.end(), RowSheet::is_nearer));
}

void Viewer::write_key(std::string& text, const Frame& frame) const {
  json::append_integer(text += R"({"type":"key","tick":)", frame.tick);
  text += R"(,"louse":[)";
  for (const RowSheet::Found& found : found_) {
    if (&found != found_.data()) text += ',';
    text += frame.sheet->text(frame.sheet->rows()[found.row]);
  }
  text += ']';
  text += frame.sheet->tail();
}

void Viewer::write_delta(std::string& text, const Frame& frame) const {
  json::append_integer(text += R"({"type":"delta","tick":)", frame.tick);
  json::append_integer(text += R"(,"base":)", frame.base);
  text += R"(,"louse":[)";
  auto known = key_ids_.cbegin();
  bool is_first = true;
  for (const RowSheet::Found& found : found_) {
    const RowSheet::Row& row = frame.sheet->rows()[found.row];
    while (known != key_ids_.cend() && *known < row.id) ++known;
    if (row.is_as_in_key && known != key_ids_.cend() && *known == row.id) continue;
    if (!std::exchange(is_first, false)) text += ',';
    text += frame.sheet->text(row);
  }
  text += R"(],"gone":[)";
  is_first = true;
  auto seen = found_.cbegin();
  for (const std::uint32_t id : key_ids_) {
    while (seen != found_.cend() && frame.sheet->rows()[seen->row].id < id) ++seen;
    if (seen != found_.cend() && frame.sheet->rows()[seen->row].id == id) continue;
    if (!std::exchange(is_first, false)) text += ',';
    json::append_integer(text, id);
  }
  text += ']';
  text += frame.sheet->tail();
}

}  // namespace woodlouse::server
