#include "shared/protocol/decode_frame.h"

#include "shared/protocol/codes.h"
#include "shared/protocol/decode_game.h"

namespace woodlouse::protocol {
namespace {

using Decoded = tl::expected<ServerMessage, DecodeError>;

/// The cell's number, still in quanta; nothing when it is not what the column and format want.
std::optional<double> cell_number(json::Value cell, Column column, bool is_integer) {
  if (!is_integer) return cell.is_number() ? std::optional(cell.number()) : std::nullopt;
  const auto integer = cell.integer();
  const std::int64_t lowest = column == Column::kId ? 1 : is_of_rules(column) ? -kMaxInteger : 0;
  const std::int64_t highest = is_of_rules(column) ? kMaxInteger : 0xffff'ffff;
  const bool in_range = integer && (!is_whole(column) || (*integer >= lowest && *integer <= highest));
  return in_range ? std::optional(static_cast<double>(*integer)) : std::nullopt;
}

void read_row(FieldReader& reader, json::Value row, std::size_t index, const FrameContext& context,
              Frame& frame) {
  if (row.kind() != json::Kind::kArray || row.size() != context.fields.size()) {
    return reader.refuse("louse", index, row,
                         "an array of " + std::to_string(context.fields.size()) + " numbers");
  }
  std::size_t place = 0;
  row.for_each([&](json::Value cell) {
    const Column column = context.fields[place++];
    const bool is_integer = context.format == Format::kQuantized || is_whole(column);
    const auto number = cell_number(cell, column, is_integer);
    if (!number) {
      reader.fail(code::kBadField, "louse[" + std::to_string(index) + "]: " + std::string(to_text(column)) +
                                       " is " + description(cell) + "; it must be " +
                                       (is_integer ? "an integer in range" : "a number"));
      return false;
    }
    const double factor = context.format == Format::kQuantized ? quantum(column) : 1.0;
    frame.values.push_back(*number * factor);
    return true;
  });
}

void read_rows(FieldReader& reader, const FrameContext& context, Frame& frame) {
  frame.columns = context.fields.size();
  if (frame.columns == 0)
    return reader.fail(code::kNotJoined, "a frame came before the welcome that names its columns");
  reader.array("louse", "an array of rows",
               [&](json::Value row, std::size_t index) { read_row(reader, row, index, context, frame); });
}

void read_its_game(FieldReader& reader, Frame& frame) {
  reader.object(
      "game", [&](FieldReader& game) { frame.game = read_game(game, frame.is_key); }, Presence::kOptional);
}

}  // namespace

Decoded read_key(FieldReader& reader, const FrameContext& context) {
  Frame frame;
  reader.integer("tick", frame.tick, kAnyTick);
  frame.base = frame.tick;
  read_rows(reader, context, frame);
  read_its_game(reader, frame);
  std::uint64_t hash = 0;
  reader.hash("hash", hash);
  frame.hash = hash;
  if (context.format == Format::kExact && context.fields == all_columns()) {
    state::HashLink proof;
    reader.hash("previous", proof.previous);
    reader.hash("inputs", proof.inputs);
    reader.hash("roster", proof.roster);
    reader.hash("rules", proof.rules);
    reader.integer("link", proof.tick, kAnyTick);
    reader.hash("generator", proof.generator);
    if (!reader.failed() && proof.tick > frame.tick) {
      reader.fail(code::kBadField,
                  "key.link is " + std::to_string(proof.tick) + "; it must not be after key.tick");
    }
    frame.proof = proof;
  }
  return reader.finish<ServerMessage>(std::move(frame));
}

Decoded read_delta(FieldReader& reader, const FrameContext& context) {
  Frame frame;
  frame.is_key = false;
  reader.integer("tick", frame.tick, kAnyTick);
  reader.integer("base", frame.base, kAnyTick);
  if (!reader.failed() && frame.base > frame.tick) {
    reader.fail(code::kBadField,
                "delta.base is " + std::to_string(frame.base) + "; it must not be after delta.tick");
  }
  read_rows(reader, context, frame);
  reader.array(
      "gone", "an array of ids",
      [&](json::Value element, std::size_t index) {
        const auto id = element.integer();
        if (!id || *id < 1 || *id > 0xffff'ffff) return reader.refuse("gone", index, element, "an id");
        frame.gone.push_back(static_cast<std::uint32_t>(*id));
      },
      Presence::kOptional);
  read_its_game(reader, frame);
  return reader.finish<ServerMessage>(std::move(frame));
}

}  // namespace woodlouse::protocol
