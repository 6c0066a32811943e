#include "shared/protocol/records.h"

#include "shared/json/object_text.h"
#include "shared/protocol/messages.h"

namespace woodlouse::protocol {
namespace {

void add_run(json::ObjectText& text, const RecordRun& run) {
  text.text("board", to_text(run.board)).text("name", run.name).text("role", to_text(run.role));
  text.integer("time", run.time);
  text.array("splits", run.splits,
             [](std::string& out, std::uint64_t split) { json::append_integer(out, split); });
  text.integer("when", run.when);
}

/// [at, kind, tx, ty, ticks]
void append_input(std::string& out, const state::GhostInput& input) {
  json::append_integer(out += '[', input.at);
  json::append_integer(out += ',', static_cast<std::uint32_t>(input.thrust.kind));
  json::append_double(out += ',', input.thrust.value.x);
  json::append_double(out += ',', input.thrust.value.y);
  json::append_integer(out += ',', input.ticks);
  out += ']';
}

}  // namespace

std::string_view to_text(Board board) {
  switch (board) {
    case Board::kBots:
      return "bots";
    case Board::kHandedIn:
      return "handed_in";
    case Board::kPeople:
      break;
  }
  return "people";
}

std::optional<Board> board_from_text(std::string_view text) {
  for (const Board board : kBoards) {
    if (to_text(board) == text) return board;
  }
  return std::nullopt;
}

void append_line(std::string& out, const Records& records) {
  json::ObjectText text(out, "records");
  text.text("board", to_text(records.board)).integer("count", records.count);
  text.objects("rows", records.rows, [](json::ObjectText& entry, const RecordRow& row) {
    entry.integer("rank", row.rank);
    add_run(entry, row.run);
  });
  text.end_line();
}

void append_line(std::string& out, const GhostLine& ghost) {
  json::ObjectText text(out, "ghost");
  add_run(text, ghost.run);
  text.integer("start", ghost.start).integer("behavior", ghost.behavior).integer("tick_hz", ghost.tick_hz);
  text.integer("spawn", ghost.ghost.spawn).integer("ticks", ghost.ghost.ticks);
  text.array("inputs", ghost.ghost.inputs, append_input);
  text.end_line();
}

}  // namespace woodlouse::protocol
