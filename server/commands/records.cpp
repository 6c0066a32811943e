#include "server/commands/records.h"

#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <ctime>
#include <memory>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "server/records/board_file.h"
#include "server/records/board_rows.h"
#include "server/records/course.h"
#include "server/records/ghost_line.h"
#include "shared/core/printable.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/match/ghost.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;
using MapPointer = std::shared_ptr<const map::Map>;

int told_error(const core::Error& error, std::ostream& out) {
  out << error.text() << '\n';
  return 1;
}

std::string seconds_text(std::uint64_t moments, std::uint32_t tick_hz) {
  return fmt::format("{:.3f} s", static_cast<double>(moments) / rules::kMomentsPerTick / tick_hz);
}

std::string about(const fs::path& file, const BoardHeader& header) {
  return fmt::format("{}: {}, {} ticks/s, behavior {}{}", core::printable(file.string()),
                     core::printable(header.map_name), header.tick_hz, header.behavior,
                     header.can_be_re_run() ? "" : ": can't be re-run here");
}

std::string day(std::uint64_t when) {
  const auto time = static_cast<std::time_t>(when);
  std::tm utc{};
  if (::gmtime_r(&time, &utc) == nullptr) return "?";
  return fmt::format("{:%Y-%m-%d %H:%M}Z", utc);
}

BoardRows rows_of(const ReadBoard& board) {
  BoardRows rows;
  for (const FileRow& row : board.rows) rows.take({row.ghost.run, Line(row.text)});
  return rows;
}

/// What is not as it should be, though nobody asked: a line each. Whether there is any that matters.
bool tell_faults(const ReadBoard& board, const fs::path& file, std::ostream& out) {
  for (const core::Error& fault : board.faults) out << fault.text() << '\n';
  if (board.torn != 0)
    out << core::printable(file.string()) << ": note: the last line is cut off (" << board.torn
        << " bytes): a server was killed while it wrote them, the next one takes them away\n";
  return !board.faults.empty();
}

int list(const fs::path& file, std::ostream& out) {
  const auto board = read_board(file);
  if (!board) return told_error(board.error(), out);
  out << about(file, board->header) << '\n';
  const bool has_faults = tell_faults(*board, file, out);
  const BoardRows rows = rows_of(*board);
  for (const protocol::Board kind : protocol::kBoards) {
    if (rows.of(kind).empty()) continue;
    out << "  " << protocol::to_text(kind) << '\n';
    std::size_t rank = 0;
    for (const Row& row : rows.of(kind))
      out << fmt::format("  {:4}. {:>12}  {}  {}\n", ++rank,
                         seconds_text(row.run.time, board->header.tick_hz), day(row.run.when),
                         core::printable(row.run.name));
  }
  return has_faults ? 1 : 0;
}

/// The map that a board was driven on: its own, or that of its name in the folder named.
core::Expected<MapPointer> map_of(const BoardHeader& header, const fs::path& file, const fs::path& maps) {
  if (header.definition.empty() && maps.empty())
    return core::fail(file.string(), "only names its map, " + header.map_file,
                      "say where it is:  --maps FOLDER");
  auto map = header.definition.empty() ? map::load_map(maps / fs::path(header.map_file).filename())
                                       : map::parse_canonical_map(header.definition, file.string());
  if (!map) return map;
  const bool is_it =
      (*map)->definition.modes.race && course_key(**map, header.tick_hz, header.behavior) == header.key;
  if (!is_it) return core::fail(file.string(), "its key is of another course than its map");
  return map;
}

int verify(const fs::path& file, const fs::path& maps, std::ostream& out) {
  const auto board = read_board(file);
  if (!board) return told_error(board.error(), out);
  if (!board->header.can_be_re_run()) {
    out << about(file, board->header) << '\n';
    return 0;
  }
  const auto map = map_of(board->header, file, maps);
  if (!map) return told_error(map.error(), out);
  std::size_t different = tell_faults(*board, file, out) ? board->faults.size() : 0;
  for (const FileRow& row : board->rows) {
    const protocol::GhostLine& ghost = row.ghost;
    const bool is_of_board =
        ghost.tick_hz == board->header.tick_hz && ghost.behavior == board->header.behavior;
    const std::string why = is_of_board
                                ? match::why_not_proven(**map, ghost.tick_hz, ghost.ghost, times_of(ghost))
                                : "it is of another tick rate or behavior than its board";
    if (why.empty()) continue;
    ++different;
    out << fmt::format("{}:{}: DIFFERENT: {}, \"{}\", {}: {}\n", core::printable(file.string()), row.line,
                       protocol::to_text(ghost.run.board), core::printable(ghost.run.name),
                       seconds_text(ghost.run.time, ghost.tick_hz), why);
  }
  if (different != 0) return 1;
  out << about(file, board->header) << ": " << board->rows.size() << " runs re-run, all the same\n";
  return 0;
}

int prune(const fs::path& file, std::size_t keep, std::ostream& out) {
  const auto board = read_board(file);
  if (!board) return told_error(board.error(), out);
  auto opened = BoardFile::open(file, board->header);
  if (!opened) return told_error(opened.error(), out);
  if (tell_faults(opened->board, file, out))
    return told_error({file.string(), "is left as it is: what can't be read would be lost", ""}, out);
  BoardRows rows = rows_of(opened->board);
  rows.cut(keep);
  std::vector<std::string_view> lines;
  rows.for_each([&lines](const Row& row) { lines.emplace_back(*row.line); });
  const std::size_t before = opened->file->size();
  if (const auto written = opened->file->replace(lines); !written) return told_error(written.error(), out);
  out << fmt::format("{}: {} of {} runs kept, {} bytes of {}\n", core::printable(file.string()), lines.size(),
                     opened->board.rows.size(), opened->file->size(), before);
  return 0;
}

int add(const RecordsRequest& request, std::ostream& out) {
  auto ghost = read_ghost_file(request.ghost);
  if (!ghost) return told_error(ghost.error(), out);
  const auto map_file = map::find_map(request.map);
  if (!map_file) return told_error(map_file.error(), out);
  const auto map = map::load_map(*map_file);
  if (!map) return told_error(map.error(), out);
  const std::string place = request.ghost.string();
  if (!(*map)->definition.modes.race) return told_error({map_file->string(), "has no race", ""}, out);
  if (ghost->behavior != match::kBehavior)
    return told_error({place, fmt::format("is of behavior {}: can't be re-run here", ghost->behavior), ""},
                      out);
  const std::string why = match::why_not_proven(**map, ghost->tick_hz, ghost->ghost, times_of(*ghost));
  if (!why.empty()) return told_error({place, "REFUSED: " + why, ""}, out);
  ghost->run.board = protocol::Board::kHandedIn;
  ghost->run.when = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
          .count());
  const BoardHeader header = header_of(**map, ghost->tick_hz, map_file->string());
  auto opened = BoardFile::open(request.folder / board_file_name(header.key), header);
  if (!opened) return told_error(opened.error(), out);
  BoardRows rows = rows_of(opened->board);
  const Line line(protocol::encode(*ghost));
  const std::uint32_t rank = rows.take({ghost->run, line});
  if (rank == 0)
    return told_error({place, "is no better than what is there, of that name or the last", ""}, out);
  if (const auto written = opened->file->append(*line); !written) return told_error(written.error(), out);
  out << fmt::format("{}: \"{}\", {}: number {} of those handed in\n",
                     core::printable(opened->file->path().string()), core::printable(ghost->run.name),
                     seconds_text(ghost->run.time, ghost->tick_hz), rank);
  return 0;
}

}  // namespace

int records_command(const RecordsRequest& request, std::ostream& out) {
  using Action = RecordsRequest::Action;
  if (request.action == Action::kAdd) return add(request, out);
  const auto files = board_files(request.folder);
  if (!files) return told_error(files.error(), out);
  if (files->empty()) out << core::printable(request.folder.string()) << ": no boards\n";
  int exit_code = 0;
  for (const fs::path& file : *files) {
    const int one = request.action == Action::kList     ? list(file, out)
                    : request.action == Action::kVerify ? verify(file, request.maps, out)
                                                        : prune(file, request.keep, out);
    if (one != 0) exit_code = one;
  }
  return exit_code;
}

}  // namespace woodlouse::server
