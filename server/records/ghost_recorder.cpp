#include "server/records/ghost_recorder.h"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <utility>
#include <variant>

#include "server/logging/events.h"
#include "shared/core/printable.h"

namespace woodlouse::server {
namespace {

constexpr Duration kTooLongEvery = std::chrono::minutes(1);

/// UTC, as people's clocks have it; no hash knows of it.
std::uint64_t unix_seconds() {
  using namespace std::chrono;
  const auto since = duration_cast<seconds>(system_clock::now().time_since_epoch()).count();
  return since > 0 ? static_cast<std::uint64_t>(since) : 0;
}

}  // namespace

void GhostRecorder::step(const LiveStep& step, const match::Match& game) {
  for (match::DrivenRun& driven : tracks_.take(step.record())) {
    const auto label = game.labels().find(driven.player);
    if (label == game.labels().end()) continue;
    const state::Role role = label->second.role;
    const protocol::Board board =
        role == state::Role::kBot ? protocol::Board::kBots : protocol::Board::kPeople;
    if (!board_->wants(board, driven.time)) continue;
    if (!driven.is_kept) {
      tell_too_long(label->second.name);
      continue;
    }
    board_->offer({std::move(driven), label->second.name, role, unix_seconds(), room_, tell_});
  }
}

void GhostRecorder::tell_too_long(const std::string& name) {
  const Time now = Clock::now();
  if (told_at_ != Time{} && now < told_at_ + kTooLongEvery) return;
  told_at_ = now;
  log_event(*log_, LogEvent::kRunNoRecord,
            fmt::format("room {}: \"{}\"'s run is no record: since its spawn there were more than {} s or {} "
                        "inputs, or all "
                        "lice's are too many",
                        room_, core::printable(name), state::kMostGhostSeconds, state::kMostGhostInputs));
}

Line GhostRecorder::answer(const protocol::ClientMessage& question) const {
  if (const auto* list = std::get_if<protocol::ListRecords>(&question)) return board_->records(list->board);
  if (const auto* get = std::get_if<protocol::GetGhost>(&question))
    return board_->ghost(get->board, get->rank);
  return {};
}

}  // namespace woodlouse::server
