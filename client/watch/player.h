// One recording being watched: keys in, scenes out. No terminal, and time is an argument.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/drawing/scene.h"
#include "client/play/interface.h"
#include "client/play/scene_builder.h"
#include "client/watch/play_clock.h"
#include "client/watch/recording_view.h"
#include "client/watch/replay_keys.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

class Screening {
 public:
  static constexpr double kSkipSeconds = 5.0;

  /// name: of the file, for the status line. The recording outlives it. view: none: see suit(). has_oblique:
  /// as Interface has it.
  Screening(RecordingView& recording, std::string name, std::optional<View> view, bool has_oblique = true);

  /// What the key asks of whoever runs the terminal (leave, suspend, draw anew), if anything.
  std::optional<Action> on_key(const Key& key);
  /// As Interface has it.
  void suit(View best) { interface_.suit(best); }
  /// Runs on to now.
  void update(core::Time now);
  [[nodiscard]] Scene scene(const FrameFacts& facts) const;

  [[nodiscard]] const PlayClock& clock() const { return clock_; }
  [[nodiscard]] const Interface& interface() const { return interface_; }

 private:
  void perform(const ReplayOrder& order);
  void follow(std::uint32_t id);
  void go_to_next_event();
  void go_to_previous_event();
  [[nodiscard]] ReplayBar bar() const;

  RecordingView& recording_;
  std::string name_;
  PlayClock clock_;
  Interface interface_;
  std::shared_ptr<const std::vector<EventMark>> marks_;
  std::string damage_;  ///< why the recording can't be shown further; empty: it can
};

}  // namespace woodlouse::client
