// The index line: written, and read back from the end of a recording.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "shared/core/joined.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/replay/index.h"
#include "shared/replay/line_fields.h"

namespace woodlouse::replay {
namespace {

using json::Fields;
using json::Problems;
using Values = std::vector<json::Value>;

constexpr json::Limits kLimits{8, 4'000'000};
constexpr std::size_t kTailBytes = 32u << 10;  // the end line and its reason fit

// ---- writing ---------------------------------------------------------------------------------------------

void append_place(std::string& out, const KeyframePlace& place) {
  json::append_integer(out += '[', place.tick);
  json::append_integer(out += ',', place.offset);
  json::append_integer(out += ',', place.line);
  out += ']';
}

void append_player(std::string& out, const PlayerSpan& player) {
  json::append_integer(out += '[', player.player);
  json::append_string(out += ',', player.label.name);
  json::append_string(out += ',', protocol::to_text(player.label.role));
  json::append_integer(out += ',', player.joined);
  out += ',';
  if (player.left) {
    json::append_integer(out, *player.left);
  } else {
    out += "null";
  }
  out += ']';
}

void append_mark(std::string& out, const Mark& mark) {
  json::append_integer(out += '[', mark.tick);
  json::append_string(out += ',', to_text(mark.kind));
  json::append_integer(out += ',', mark.player);
  out += ']';
}

// ---- reading ---------------------------------------------------------------------------------------------

/// Calls read(values) for each row of that many values.
template <typename Read>
void read_rows(const Fields& fields, std::string_view key, std::size_t columns, Problems& problems,
               const Read& read) {
  const auto list = fields.demand(key);
  if (!list) return;
  if (!list->is(json::Kind::kArray)) return problems.add(*list, "a list is wanted");
  list->for_each([&](const json::Value& row) {
    const Values values = row.children();
    if (!row.is(json::Kind::kArray) || values.size() != columns) {
      problems.add(row, "is no row");
    } else {
      read(values);
    }
    return problems.count() == 0;
  });
}

std::uint64_t number(const json::Value& value, std::uint64_t max, Problems& problems) {
  return json::integer_in(value, 0, max, problems).value_or(0);
}

match::PlayerId player_id(const json::Value& value, Problems& problems) {
  return static_cast<match::PlayerId>(number(value, UINT32_MAX, problems));
}

MarkKind kind_of(const json::Value& value, Problems& problems) {
  const std::string text = json::any_text(value, kMaxTextBytes, problems);
  for (const MarkKind kind : {MarkKind::kJoin, MarkKind::kLeave, MarkKind::kRespawn, MarkKind::kChat}) {
    if (to_text(kind) == text) return kind;
  }
  problems.add(value, "is no mark");
  return MarkKind::kJoin;
}

ReplayIndex read_fields(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"index", "keyframes", "players", "marks", "inputs"}, problems);
  ReplayIndex index;
  index.last_tick = fields.integer("index", 0, kMaxTick);
  index.inputs = fields.integer("inputs", 0, kMaxOffset);
  read_rows(fields, "keyframes", 3, problems, [&](const Values& row) {
    index.keyframes.push_back({number(row[0], kMaxTick, problems), number(row[1], kMaxOffset, problems),
                               number(row[2], kMaxOffset, problems)});
  });
  read_rows(fields, "players", 5, problems, [&](const Values& row) {
    PlayerSpan player{player_id(row[0], problems),
                      label_of(row[1], row[2], problems),
                      number(row[3], kMaxTick, problems),
                      {}};
    if (!row[4].is(json::Kind::kNull)) player.left = number(row[4], kMaxTick, problems);
    index.players.push_back(std::move(player));
  });
  read_rows(fields, "marks", 3, problems, [&](const Values& row) {
    index.marks.push_back(
        {number(row[0], kMaxTick, problems), kind_of(row[1], problems), player_id(row[2], problems)});
  });
  return index;
}

/// By tick or id, as who looks something up in it trusts.
bool is_in_order(const ReplayIndex& index) {
  const auto follows = [](const KeyframePlace& a, const KeyframePlace& b) {
    return a.tick >= b.tick || a.offset >= b.offset || a.line >= b.line;
  };
  const auto& places = index.keyframes;
  return !places.empty() && std::adjacent_find(places.begin(), places.end(), follows) == places.end() &&
         places.back().tick <= index.last_tick &&
         std::adjacent_find(index.players.begin(), index.players.end(),
                            [](const PlayerSpan& a, const PlayerSpan& b) { return a.player >= b.player; }) ==
             index.players.end() &&
         std::is_sorted(index.marks.begin(), index.marks.end(),
                        [](const Mark& a, const Mark& b) { return a.tick < b.tick; }) &&
         index.players.size() <= ReplayIndex::kMaxPlayers && index.marks.size() <= ReplayIndex::kMaxMarks;
}

/// The last whole line; nothing when it is longer than an end can be.
std::optional<std::string> last_line(InputStream& in) {
  in.clear();
  in.seekg(0, std::ios::end);
  const auto size = static_cast<std::streamoff>(in.tellg());
  if (in.fail() || size <= 0) return std::nullopt;
  const std::streamoff begin = std::max<std::streamoff>(0, size - static_cast<std::streamoff>(kTailBytes));
  std::string tail(static_cast<std::size_t>(size - begin), '\0');
  in.seekg(begin);
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  if (static_cast<std::size_t>(in.gcount()) != tail.size() || tail.back() != '\n') return std::nullopt;
  tail.pop_back();
  const std::size_t before = tail.rfind('\n');
  if (before == std::string::npos) return std::nullopt;
  return tail.substr(before + 1);
}

std::optional<End> read_end(InputStream& in, const std::string& source) {
  const std::optional<std::string> text = last_line(in);
  if (!text || text->compare(0, 7, "{\"end\":") != 0) return std::nullopt;
  const auto document = json::parse_file(*text, source, kLimits);
  if (!document) return std::nullopt;
  Problems problems(source);
  const Fields fields(document->root(), {"end", "reason", "index"}, problems);
  End end{fields.integer("end", 0, kMaxTick), fields.text("reason", kMaxTextBytes),
          fields.integer("index", 0, kMaxOffset)};
  if (problems.count() != 0) return std::nullopt;
  return end;
}

}  // namespace

void append_index(std::string& out, const ReplayIndex& index) {
  json::ObjectText line(out);
  line.integer("index", index.last_tick).integer("inputs", index.inputs);
  line.array("keyframes", index.keyframes, append_place);
  line.array("players", index.players, append_player);
  line.array("marks", index.marks, append_mark);
  line.end();
  out += '\n';
}

core::Expected<ReplayIndex> parse_index(const std::string& text, const std::string& source,
                                        std::size_t line) {
  const auto document = json::parse_file(text, source, kLimits, line);
  if (!document) return tl::unexpected(document.error());
  Problems problems(source);
  ReplayIndex index = read_fields(document->root(), problems);
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  if (!is_in_order(index)) {
    return core::fail(core::joined({source, ":", std::to_string(line), ": index"}),
                      "keyframes, players or marks are out of order", "it was altered");
  }
  return index;
}

std::optional<ReplayIndex> read_index(InputStream& in, const std::string& source) {
  std::optional<End> end = read_end(in, source);
  if (!end) return std::nullopt;
  in.clear();
  in.seekg(static_cast<std::streamoff>(end->index_offset));
  std::string line;
  for (int c = in.rdbuf()->sbumpc(); c != '\n'; c = in.rdbuf()->sbumpc()) {
    if (c == std::char_traits<char>::eof() || line.size() >= kMaxReplayLineBytes) return std::nullopt;
    line += static_cast<char>(c);
  }
  if (line.compare(0, 9, "{\"index\":") != 0) return std::nullopt;
  core::Expected<ReplayIndex> index = parse_index(line, source, 0);
  if (!index || index->last_tick != end->tick) return std::nullopt;
  index->end = std::move(end);
  return std::move(*index);
}

}  // namespace woodlouse::replay
