#include "server/records/board.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "server/records/book.h"
#include "shared/core/printable.h"

namespace woodlouse::server {
namespace {

constexpr Duration kTryAgainAfter = std::chrono::seconds(5);

}  // namespace

core::Expected<std::shared_ptr<Board>> Board::open(const std::filesystem::path& folder,
                                                   std::shared_ptr<const map::Map> map, std::uint32_t tick_hz,
                                                   const std::string& map_file,
                                                   std::shared_ptr<spdlog::logger> log) {
  const BoardHeader header = header_of(*map, tick_hz, map_file);
  auto opened = BoardFile::open(folder / board_file_name(header.key), header);
  if (!opened) return tl::unexpected(opened.error());
  return std::shared_ptr<Board>(
      new Board(std::make_shared<Book>(std::move(map), tick_hz, std::move(*opened), std::move(log))));
}

Board::Board(std::shared_ptr<Book> book)
    : book_(std::move(book)), thread_(kMaxQueued, kTryAgainAfter, [book = book_] { book->try_again(); }) {
  static_cast<void>(thread_.post([book = book_] { book->begin(); }));
}

bool Board::offer(LiveRun run) {
  auto shared = std::make_shared<const LiveRun>(std::move(run));
  book_->expect(true);
  const bool is_in = thread_.post([book = book_, shared] {
    book->take(*shared);
    book->expect(false);
  });
  if (is_in) return true;
  book_->expect(false);
  book_->say(LogEvent::kRunLeftOut,
             fmt::format("room {}: \"{}\"'s run of {:.2f} ticks is left out: {} others wait to be re-run",
                         shared->room, core::printable(shared->name),
                         static_cast<double>(shared->driven.time) / rules::kMomentsPerTick, kMaxQueued));
  return false;
}

bool Board::wants(protocol::Board board, std::uint64_t time) const {
  const std::uint64_t worst = book_->shown()->of(board).worst;
  return worst == 0 || time < worst;
}

Line Board::records(protocol::Board board) const { return book_->shown()->of(board).records; }

Line Board::ghost(protocol::Board board, std::uint32_t rank) const {
  const auto shown = book_->shown();
  const std::vector<Line>& ghosts = shown->of(board).ghosts;
  return rank >= 1 && rank <= ghosts.size() ? ghosts[rank - 1] : Line();
}

void Board::end(Time latest) {
  thread_.close();
  static_cast<void>(thread_.wait_until(latest));
  book_->leave_behind();
}

std::vector<std::string> Board::lost() const { return book_->lost(); }

}  // namespace woodlouse::server
