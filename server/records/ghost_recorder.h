// Watches a room's race for runs that may be records, and answers who asks for the board.
#pragma once

#include <spdlog/logger.h>

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "server/records/board.h"
#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "shared/match/ghost_tracks.h"

namespace woodlouse::server {

/// It is done whenever its room is: what it handed over is its board's.
class GhostRecorder final : public TickWatcher {
 public:
  GhostRecorder(std::string room, std::uint32_t tick_hz, std::shared_ptr<Board> board,
                std::shared_ptr<spdlog::logger> log)
      : room_(std::move(room)), board_(std::move(board)), log_(std::move(log)), tracks_(tick_hz) {}

  void attach_events(Tell tell) override { tell_ = std::move(tell); }
  void begin(const match::Match&) override {}
  void step(const LiveStep& step, const match::Match& game) override;
  [[nodiscard]] Line answer(const protocol::ClientMessage& question) const override;
  void finish(const std::string&, std::function<void()> done) override { done(); }

 private:
  void tell_too_long(const std::string& name);

  const std::string room_;
  const std::shared_ptr<Board> board_;
  const std::shared_ptr<spdlog::logger> log_;
  match::GhostTracks tracks_;
  Tell tell_;
  Time told_at_{};  ///< that one was too long
};

}  // namespace woodlouse::server
