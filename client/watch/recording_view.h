// A recording as it is watched: the lice at any tick, their trails, who they are, what was said, and whether
// the re-run gives what was recorded. No terminal; the one clock it knows is the budget for proving.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "client/drawing/scene.h"
#include "client/play/stream_view.h"
#include "client/play/visible_lice.h"
#include "client/watch/recorded_chat.h"
#include "client/watch/recording_proof.h"
#include "shared/core/clock.h"
#include "shared/core/error.h"
#include "shared/match/found_lice.h"
#include "shared/match/live_error.h"
#include "shared/replay/archive.h"
#include "shared/replay/playback.h"

namespace woodlouse::client {

class RecordingView {
 public:
  static constexpr double kTrailSeconds = 4.0;  ///< re-run before a tick that is jumped to, for the trails

  /// Stands at the recording's first tick. Errors: those of ReplayArchive.
  static core::Expected<std::unique_ptr<RecordingView>> open(replay::ReplaySource source);

  /// Goes to a tick of the recording. Error: it is damaged there; the view stands at tick(), somewhere else.
  core::Expected<void> show(std::uint64_t tick);
  /// Re-runs the recording from its beginning, beside what is shown, until `deadline` or its end: after a
  /// while every tick is proven, wherever one looks.
  void prove(core::Time deadline);

  /// How far this louse's steps err is counted from here on, over what is played; 0: nobody's is, and nothing
  /// costs. Another one than before, and a jump (forth by more than kTrailSeconds, or back), begin anew.
  void measure(std::uint32_t id);
  /// Nothing before the first tick that is played.
  [[nodiscard]] std::optional<match::ErrorReading> error() const {
    return error_ ? error_->reading() : std::nullopt;
  }

  [[nodiscard]] std::uint64_t tick() const { return playback_->tick(); }
  [[nodiscard]] Sight sight() const;
  /// The exact louse; null when it is not there.
  [[nodiscard]] const state::Louse* louse(std::uint32_t id) const {
    return playback_->match().world().find(id);
  }
  /// The newest lines up to tick().
  [[nodiscard]] std::vector<ChatLine> chat() const { return chat_.lines(archive_->marks(), labels_, tick()); }
  [[nodiscard]] const RecordingProof& proof() const { return proof_; }
  [[nodiscard]] const replay::ReplayArchive& archive() const { return *archive_; }

 private:
  RecordingView(std::shared_ptr<const replay::ReplayArchive> archive,
                std::unique_ptr<replay::Playback> playback, std::unique_ptr<replay::Playback> prover);

  core::Expected<void> run_to(std::uint64_t tick);
  void begin_error();
  void count_error(const state::Louse& before, const match::StepRecord& step);
  void extend_trails();
  void take_lice();

  std::shared_ptr<const replay::ReplayArchive> archive_;
  std::unique_ptr<replay::Playback> playback_;  ///< what is shown
  std::unique_ptr<replay::Playback> prover_;    ///< null once there is nothing more to learn
  std::map<std::uint32_t, match::PlayerLabel> labels_;
  Snapshot shown_;  ///< at tick()
  std::map<std::uint32_t, Present> lice_;
  std::map<std::uint32_t, Trail> trails_;
  std::uint32_t measured_ = 0;
  std::unique_ptr<match::LiveError> error_;  ///< null: nobody asks
  std::unique_ptr<match::FoundLice> found_;  ///< with it
  RecordedChat chat_;
  RecordingProof proof_;
};

}  // namespace woodlouse::client
