#include "server/records/book.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "server/logging/events.h"
#include "server/records/ghost_line.h"
#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/match/ghost.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"

namespace woodlouse::server {
namespace {

constexpr Duration kTellEvery = std::chrono::minutes(1);  // that the disk fails

Line shown_rows(protocol::Board board, const std::vector<Row>& rows) {
  protocol::Records records;
  records.board = board;
  records.count = static_cast<std::uint32_t>(rows.size());
  for (const Row& row : rows) {
    if (records.rows.size() == protocol::kMostRecordsShown) break;
    records.rows.push_back({static_cast<std::uint32_t>(records.rows.size() + 1), row.run});
  }
  return Line(protocol::encode(records));
}

/// "Mara's run of 1234.5 ticks"
std::string run_name(const std::string& name, std::uint64_t time) {
  return fmt::format("\"{}\"'s run of {:.2f} ticks", core::printable(name),
                     static_cast<double>(time) / rules::kMomentsPerTick);
}

}  // namespace

Board::Book::Book(std::shared_ptr<const map::Map> map, std::uint32_t tick_hz, BoardFile::Opened opened,
                  std::shared_ptr<spdlog::logger> log)
    : map_(std::move(map)),
      tick_hz_(tick_hz),
      name_(opened.file->path().string()),
      log_(std::move(log)),
      file_(std::move(opened.file)),
      of_file_(std::move(opened.board.rows)),
      has_strange_lines_(!opened.board.faults.empty()) {
  if (opened.board.torn != 0)
    log_event(*log_, LogEvent::kBoardTorn,
              fmt::format("{}: the last line was cut off, {} bytes of it are gone: a server was killed while "
                          "it wrote them",
                          name_, opened.board.torn));
  for (const core::Error& fault : opened.board.faults)
    log_event(*log_, LogEvent::kBoardLinePassedOver,
              fmt::format("{}: {}: passed over", fault.where, fault.what));
  show();
}

// ---- any thread ----------------------------------------------------------------------------------------

std::shared_ptr<const Board::Book::Shown> Board::Book::shown() const {
  const std::lock_guard lock(outside_);
  return shown_;
}

void Board::Book::say(LogEvent event, const std::string& text) {
  const std::lock_guard lock(outside_);
  if (log_) log_event(*log_, event, text);
}

void Board::Book::leave_behind() {
  is_left_ = true;
  const std::lock_guard lock(outside_);
  is_cut_off_ = expected_ != 0;
  log_ = nullptr;
}

std::vector<std::string> Board::Book::lost() const {
  const std::lock_guard lock(outside_);
  std::vector<std::string> lost;
  for (const std::string& run : unwritten_names_) lost.push_back(core::joined({name_, ": ", run}));
  if (is_cut_off_) lost.push_back(core::joined({name_, ": what was driven last: the disk takes nothing"}));
  return lost;
}

// ---- its thread ----------------------------------------------------------------------------------------

void Board::Book::begin() {
  for (FileRow& row : std::exchange(of_file_, {})) {
    if (is_left_) {
      has_strange_lines_ = true;  // those that are not looked at
      return;
    }
    const protocol::GhostLine& ghost = row.ghost;
    const std::string why = ghost.tick_hz != tick_hz_ || ghost.behavior != match::kBehavior
                                ? "it is of another tick rate or behavior"
                                : match::why_not_proven(*map_, tick_hz_, ghost.ghost, times_of(ghost));
    if (why.empty()) {
      rows_.take({ghost.run, Line(std::move(row.text))});
      continue;
    }
    has_strange_lines_ = true;
    say(LogEvent::kRecordRefused,
        fmt::format("RECORD REFUSED: {}:{}: {}: {}; it stands in the file and on no board", name_, row.line,
                    run_name(ghost.run.name, ghost.run.time), why));
  }
  show();
}

void Board::Book::take(const LiveRun& run) {
  const match::DrivenRun& driven = run.driven;
  const std::string whose = fmt::format("room {}: {}", run.room, run_name(run.name, driven.time));
  std::string why = match::why_no_ghost(*map_, tick_hz_, driven.ghost);
  match::Rerun again;
  if (why.empty()) {
    again = match::rerun(*map_, tick_hz_, driven.ghost);
    why = match::departure(*map_, driven.times, driven.ghost, again);
  }
  if (!why.empty()) {
    const bool began_before =
        !again.times.gates.empty() && again.times.gates[0] < driven.counted_from * rules::kMomentsPerTick;
    if (began_before)
      return say(LogEvent::kRunNoRecord, whose + " is no record: it began before its round did");
    return say(LogEvent::kRecordRefused,
               core::joined({"RECORD REFUSED: ", whose, ": ", why, ": the game and its re-run differ"}));
  }
  protocol::RecordRun row;
  row.board = run.role == state::Role::kBot ? protocol::Board::kBots : protocol::Board::kPeople;
  row.name = run.name;
  row.role = run.role;
  row.when = run.when;
  const protocol::GhostLine line = line_of(driven, tick_hz_, std::move(row));
  const Line text(protocol::encode(line));
  const std::uint32_t rank = rows_.take({line.run, text});
  if (rank == 0) return;
  show();
  if (rank == 1) tell(run);
  write(line.run, text);
}

/// All that is unwritten, or nothing: what is behind a row that failed fails too, or stands in its place.
void Board::Book::write(const protocol::RecordRun& run, Line line) {
  unwritten_.push_back(std::move(line));
  {
    const std::lock_guard lock(outside_);
    unwritten_names_.push_back(run_name(run.name, run.time));
  }
  try_again();
}

void Board::Book::try_again() {
  if (unwritten_.empty()) return;
  while (!unwritten_.empty()) {
    const auto written = file_->append(*unwritten_.front());
    if (!written) {
      if (has_strange_lines_) return note(written);
      return write_anew();  // where the file is gone, that makes another one
    }
    unwritten_.erase(unwritten_.begin());
    const std::lock_guard lock(outside_);
    unwritten_names_.erase(unwritten_names_.begin());
  }
  note({});
  if (!has_strange_lines_ && file_->size() > 2 * rows_.bytes() + kSpareBytes) write_anew();
}

/// The boards as they are now.
void Board::Book::write_anew() {
  std::vector<std::string_view> lines;
  rows_.for_each([&lines](const Row& row) { lines.emplace_back(*row.line); });
  const auto written = file_->replace(lines);
  if (written) {
    unwritten_.clear();
    const std::lock_guard lock(outside_);
    unwritten_names_.clear();
  }
  note(written);
}

void Board::Book::note(const core::Expected<void>& outcome) {
  if (outcome) {
    if (std::exchange(is_failing_, false))
      say(LogEvent::kRecordsWrittenAgain, fmt::format("{}: written again, nothing is lost", name_));
    return;
  }
  const Time now = Clock::now();
  const bool is_new = !std::exchange(is_failing_, true);
  if (!is_new && now < told_at_ + kTellEvery) return;
  told_at_ = now;
  say(LogEvent::kRecordsNotWritten,
      fmt::format(
          "RECORDS NOT WRITTEN: {}: {}; {} runs stand on the board and in no file, they are tried again "
          "with the next one and at the end",
          outcome.error().where, outcome.error().what, unwritten_.size()));
}

void Board::Book::tell(const LiveRun& run) {
  protocol::Event event;
  event.kind = protocol::EventKind::kRecord;
  event.id = run.driven.player;
  event.name = run.name;
  event.moment = run.driven.ended;
  event.tick = run.driven.ended / rules::kMomentsPerTick;
  event.values[0] = static_cast<std::int64_t>(run.driven.time);
  event.values[1] = run.role == state::Role::kBot ? 1 : 0;
  const std::lock_guard lock(outside_);
  if (log_ && run.tell) run.tell(event);
}

void Board::Book::show() {
  auto shown = std::make_shared<Shown>();
  for (const protocol::Board board : protocol::kBoards) {
    const std::vector<Row>& rows = rows_.of(board);
    Shown::Of& of = shown->boards[static_cast<std::size_t>(board)];
    of.records = shown_rows(board, rows);
    for (const Row& row : rows) of.ghosts.push_back(row.line);
    if (rows.size() == BoardRows::kMost) of.worst = rows.back().run.time;
  }
  const std::lock_guard lock(outside_);
  shown_ = std::move(shown);
}

}  // namespace woodlouse::server
