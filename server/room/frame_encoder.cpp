#include "server/room/frame_encoder.h"

#include <cassert>
#include <cstring>
#include <utility>

#include "shared/core/stable_hash.h"
#include "shared/json/text.h"

namespace woodlouse::server {
namespace {

bool same_bytes(const state::Louse& a, const state::Louse& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// What besides the rows went into the hash.
void append_proof(std::string& text, const state::HashLink& link) {
  text += R"(,"previous":")" + core::to_hex(link.previous) + R"(","inputs":")" + core::to_hex(link.inputs);
  text += R"(","roster":")" + core::to_hex(link.roster) + R"(","rules":")" + core::to_hex(link.rules);
  text += R"(","link":)";
  json::append_integer(text, link.tick);
  text += R"(,"generator":")" + core::to_hex(link.generator) + '"';
}

}  // namespace

FrameEncoder::FrameEncoder(RowLayout layout) : rows_(std::move(layout)) {
  proves_hash_ =
      rows_.layout().format == protocol::Format::kExact && rows_.layout().fields == protocol::all_columns();
}

Frame FrameEncoder::key(const Scene& scene) {
  std::string text = R"({"type":"key","tick":)";
  json::append_integer(text, scene.tick);
  text += R"(,"louse":[)";
  key_rows_.clear();
  for (const state::Louse& louse : scene.lice) {
    if (!key_rows_.empty()) text += ',';
    const std::size_t begin = text.size();
    rows_.append(text, louse, scene.terrain);
    key_rows_.push_back({louse, begin, text.size()});
  }
  text += R"(],"hash":")" + core::to_hex(scene.hash) + '"';
  if (proves_hash_) append_proof(text, scene.link);
  text += "}\n";
  key_tick_ = scene.tick;
  key_text_ = std::make_shared<const std::string>(std::move(text));
  return {FrameKind::kKey, scene.tick, scene.tick, scene.index, key_text_};
}

Frame FrameEncoder::delta(const Scene& scene) {
  assert(key_text_);
  std::string text = R"({"type":"delta","tick":)";
  json::append_integer(text, scene.tick);
  text += R"(,"base":)";
  json::append_integer(text, key_tick_);
  text += R"(,"louse":[)";
  std::string gone;
  auto known = key_rows_.cbegin();
  const auto report_gone = [&] {
    if (!gone.empty()) gone += ',';
    json::append_integer(gone, known->louse.id);
    ++known;
  };
  bool first = true;
  for (const state::Louse& louse : scene.lice) {
    while (known != key_rows_.cend() && known->louse.id < louse.id) report_gone();
    const bool is_known = known != key_rows_.cend() && known->louse.id == louse.id;
    if (is_known && same_bytes(known->louse, louse)) {
      ++known;
      continue;
    }
    scratch_.clear();
    rows_.append(scratch_, louse, scene.terrain);
    if (is_known) {
      const KeyRow& row = *known++;
      if (std::string_view(*key_text_).substr(row.begin, row.end - row.begin) == scratch_) continue;
    }
    if (!std::exchange(first, false)) text += ',';
    text += scratch_;
  }
  while (known != key_rows_.cend()) report_gone();
  text += R"(],"gone":[)" + gone + "]}\n";
  return {FrameKind::kDelta, scene.tick, key_tick_, scene.index,
          std::make_shared<const std::string>(std::move(text))};
}

}  // namespace woodlouse::server
