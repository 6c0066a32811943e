#include "shared/protocol/decode_records.h"

#include <utility>
#include <vector>

#include "shared/protocol/field_reader.h"
#include "shared/protocol/field_texts.h"

namespace woodlouse::protocol {
namespace {

constexpr ByteRange kDriverBytes{0, kMaxNameBytes};

void read_run(FieldReader& reader, RecordRun& run) {
  reader.choice("board", run.board, kBoardTexts, board_from_text);
  reader.cleaned_text("name", run.name, kDriverBytes);
  reader.choice("role", run.role, kRoleTexts, role_from_text);
  reader.integer("time", run.time, kAnyTick);
  reader.array("splits", "an array of moments", [&](json::Value element, std::size_t index) {
    const auto split = json::integer_of(element, 0, kMaxInteger);
    if (!split || index >= kMostSplits)
      return reader.refuse("splits", index, element, "a moment, of 3201 at most");
    run.splits.push_back(static_cast<std::uint64_t>(*split));
  });
  reader.integer("when", run.when, kAnyTick);
}

void read_driven(FieldReader& reader, json::Value element, std::size_t index,
                 std::vector<state::GhostInput>& inputs) {
  constexpr std::string_view kWants = "[at, kind, tx, ty, ticks]";
  const std::vector<json::Value> cells = element.children();
  const auto whole = [&cells](std::size_t k, std::int64_t high) {
    return json::integer_of(cells[k], 0, high).has_value();
  };
  const bool fits = element.kind() == json::Kind::kArray && cells.size() == 5 &&
                    index < state::kMostGhostInputs && whole(0, 0xffff'ffff) && whole(1, 2) &&
                    cells[2].is_number() && cells[3].is_number() && whole(4, 0xffff'ffff);
  if (!fits) return reader.refuse("inputs", index, element, kWants);
  inputs.push_back(
      {static_cast<std::uint32_t>(*cells[0].integer()),
       {static_cast<state::ThrustKind>(*cells[1].integer()), {cells[2].number(), cells[3].number()}},
       static_cast<std::uint32_t>(*cells[4].integer())});
}

}  // namespace

tl::expected<ServerMessage, DecodeError> read_records(FieldReader& reader, const FrameContext&) {
  Records records;
  reader.choice("board", records.board, kBoardTexts, board_from_text);
  reader.integer("count", records.count, kAnyUint32);
  reader.objects("rows", [&](FieldReader& entry) {
    RecordRow row;
    entry.integer("rank", row.rank, kAnyUint32);
    read_run(entry, row.run);
    records.rows.push_back(std::move(row));
  });
  return reader.finish<ServerMessage>(std::move(records));
}

tl::expected<ServerMessage, DecodeError> read_ghost(FieldReader& reader, const FrameContext&) {
  GhostLine line;
  read_run(reader, line.run);
  reader.integer("start", line.start, kAnyTick);
  reader.integer("behavior", line.behavior, {0, 0x7fff'ffff});
  reader.integer("tick_hz", line.tick_hz, {1, 1000});
  reader.integer("spawn", line.ghost.spawn, kAnyUint32);
  reader.integer("ticks", line.ghost.ticks, kAnyUint32);
  reader.array("inputs", "an array of inputs", [&](json::Value element, std::size_t index) {
    read_driven(reader, element, index, line.ghost.inputs);
  });
  return reader.finish<ServerMessage>(std::move(line));
}

}  // namespace woodlouse::protocol
