// What a louse is, and the proof of many.
#include <cassert>
#include <cstddef>
#include <cstring>
#include <span>

#include "shared/core/stable_hash.h"
#include "shared/json/object_text.h"
#include "shared/match/match.h"
#include "shared/state/louse_fields.h"
#include "shared/state/state_hash.h"
#include "web/core/answer.h"
#include "web/core/bytes.h"

namespace woodlouse::web {

/// match::kBehavior: the same inputs give the same bits as those of a server that says the same.
WOODLOUSE_EXPORT(behavior) int behavior() { return match::kBehavior; }

/// Answers with how a louse lies in memory, field after field: [{"name", "unit", "offset", "size" (4: an
/// unsigned integer, 8: a double), "quantum"}, ...]
WOODLOUSE_EXPORT(louse_fields) void louse_fields() {
  json::append_array(answer(), state::kLouseFields, [](std::string& out, const state::LouseField& field) {
    json::ObjectText text(out);
    text.text("name", field.name).text("unit", field.unit).integer("offset", field.offset);
    text.integer("size", field.size).number("quantum", field.quantum).end();
  });
}

/// Answers with the hash of a key, 16 hex digits. `link`: six u64: previous, inputs, roster, rules, tick,
/// generator (state_hash.h); `lice`: so many, by ascending id.
WOODLOUSE_EXPORT(key_hash) void key_hash(const char* link, const state::Louse* lice, std::size_t count) {
  static_assert(sizeof(state::HashLink) == 48);
  assert(count <= 1'000'000);
  state::HashLink of;
  std::memcpy(&of, bytes_at(link, sizeof of).data(), sizeof of);
  bytes_at(reinterpret_cast<const char*>(lice), count * sizeof *lice);
  core::StableHasher hasher;
  answer() = core::to_hex(state::state_hash(hasher, of, std::span(lice, count)));
}

}  // namespace woodlouse::web
