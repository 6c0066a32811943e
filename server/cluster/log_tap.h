// What a room's game tells the log: values are copied on the room's strand, lines are made of them on the
// log's own thread. Where that can't keep up, lines are left out, and the game is told anew from its next
// keyframe on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "server/cluster/shard_text.h"
#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "shared/match/match.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

/// Where taps hand over what their rooms tell. Any thread; returns at once.
class LogDesk {
 public:
  using Job = std::function<void(ShardText& text, Time now)>;

  LogDesk() = default;
  LogDesk(const LogDesk&) = delete;
  LogDesk& operator=(const LogDesk&) = delete;
  virtual ~LogDesk() = default;
  /// False, and nothing done: too much waits.
  [[nodiscard]] virtual bool post(Job job) = 0;
  /// What somebody waits for: it is looked at soon. Each game has at most one such job here.
  virtual void post_soon(Job job) = 0;
  /// Whoever was away may have lost his rooms meanwhile: they are in doubt until the log is asked.
  virtual void doubt() = 0;
  [[nodiscard]] virtual bool is_in_doubt() const = 0;
  /// Another number: all that was told is lost, and every room is to be told anew at once.
  [[nodiscard]] virtual std::uint64_t beginnings() const = 0;
};

class LogTap final : public TickWatcher {
 public:
  /// away: between two ticks; after that the game is in doubt. is_strict: nobody is shown what is not stored.
  LogTap(std::shared_ptr<LogDesk> desk, std::string room, replay::Header header, Duration away,
         bool is_strict = false);

  void attach(Announce announce) override { announce_ = std::move(announce); }
  void begin(const match::Match& game) override;
  void claimed(const Claim& claim) override;
  void chat(std::uint64_t tick, match::PlayerId player, const std::string& name,
            const std::string& text) override;
  void step(const LiveStep& step, const match::Match& game) override;
  void fall_asleep(const match::Match& game) override;
  void wake(const match::Match&) override { stepped_at_ = Time::max(); }
  [[nodiscard]] bool await_kept(const std::function<void()>& kept) override;
  [[nodiscard]] bool may_show() override;
  void finish(const std::string& reason, std::function<void()> done) override;

 private:
  [[nodiscard]] bool post(LogDesk::Job job);
  void tell_begin(const match::Match& game);

  const std::shared_ptr<LogDesk> desk_;
  const TapNumber number_;
  const std::string room_;
  const replay::Header header_;
  const std::uint64_t keyframe_ticks_;
  const Duration away_;
  const bool is_strict_;
  Time stepped_at_ = Time::max();  ///< the last step; max: none since it began, or stood still
  Announce announce_;
  std::uint64_t beginnings_ = 0;
  bool has_begun_ = false;  ///< the log knows of the game
  bool has_lost_ = false;   ///< something since the last keyframe that was taken
};

}  // namespace woodlouse::server
