// Which ticks of a recording were re-run here with the recorded hash, and the first that was not.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "shared/replay/playback.h"

namespace woodlouse::client {

/// A tick whose re-run gave another hash.
struct TickDifference {
  std::uint64_t tick = 0;
  std::uint64_t recorded = 0;
  std::uint64_t rerun = 0;
};

/// One line: the tick and both hashes.
std::string to_text(const TickDifference& difference);

class RecordingProof {
 public:
  /// Of the ticks after `first` up to `last`.
  RecordingProof(std::uint64_t first, std::uint64_t last) : first_(first), last_(last) {}

  /// A tick that is re-run twice counts once.
  void take(const replay::PlayedStep& step);

  [[nodiscard]] std::uint64_t proven() const { return count_; }
  [[nodiscard]] std::uint64_t total() const { return last_ - first_; }
  /// Of the tick proven last; 0 before any.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  /// The earliest that is known.
  [[nodiscard]] const std::optional<TickDifference>& difference() const { return difference_; }

 private:
  std::uint64_t first_;
  std::uint64_t last_;
  std::map<std::uint64_t, std::uint64_t>
      proven_;  ///< stretches of ticks: the first, and the one after the last
  std::uint64_t count_ = 0;
  std::uint64_t hash_ = 0;
  std::optional<TickDifference> difference_;
};

}  // namespace woodlouse::client
