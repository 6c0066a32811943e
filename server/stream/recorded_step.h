// The step that a room has just done, for who records it and who watches by inputs: its line is made once, by
// whoever asks for it first, and by nobody where nobody does.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shared/match/match.h"

namespace woodlouse::server {

/// How long before its step an input came; negative: after the step it asked for.
struct InputMargin {
  match::PlayerId player = 0;
  std::uint32_t seq = 0;
  std::int64_t microseconds = 0;
};

/// A step that outlives its tick. Any thread.
class RecordedStep {
 public:
  RecordedStep(match::StepRecord record, std::vector<InputMargin> margins)
      : record_(std::move(record)), margins_(std::move(margins)) {}

  [[nodiscard]] const match::StepRecord& record() const { return record_; }
  /// Its line in a recording (replay/line_writer.h), newline included.
  [[nodiscard]] const std::string& line() const;

 private:
  const match::StepRecord record_;
  const std::vector<InputMargin> margins_;
  mutable std::once_flag is_made_;
  mutable std::string line_;
};

using SharedStep = std::shared_ptr<const RecordedStep>;

/// The same within its tick: copied for those alone who need it longer, all together once. One thread.
class LiveStep {
 public:
  /// Both outlive it. margins: of the step's inputs that came from sessions.
  LiveStep(const match::StepRecord& record, std::span<const InputMargin> margins)
      : record_(record), margins_(margins) {}
  LiveStep(const LiveStep&) = delete;
  LiveStep& operator=(const LiveStep&) = delete;

  [[nodiscard]] const match::StepRecord& record() const { return record_; }
  [[nodiscard]] std::span<const InputMargin> margins() const { return margins_; }
  [[nodiscard]] const SharedStep& shared() const;

 private:
  const match::StepRecord& record_;
  std::span<const InputMargin> margins_;
  mutable SharedStep shared_;
};

}  // namespace woodlouse::server
