// What a louse is, and by which behavior it moves.
#include "shared/json/object_text.h"
#include "shared/match/match.h"
#include "shared/state/louse_fields.h"
#include "web/core/answer.h"

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

}  // namespace woodlouse::web
