// Gives the lesson to whoever plays for the first time, and remembers who has had it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/play/modes/lesson.h"
#include "client/play/visible_lice.h"

namespace woodlouse::client {

class Teacher {
 public:
  /// data: where it is remembered; empty: nowhere, and there is no lesson.
  explicit Teacher(std::filesystem::path data);

  /// Your louse now; nothing without one. True: what lines() says is another thing now.
  bool observe(const Sight& sight, core::Time now);
  /// The player has had enough; false: there was no lesson.
  bool dismiss();
  /// See Lesson.
  [[nodiscard]] std::vector<GoalLine> lines(const KeyLabels& keys, core::Vec2 towards,
                                            Winds winds = Winds::kShort) const;

 private:
  void end();

  std::filesystem::path data_;
  bool is_new_;  ///< the player; the lesson begins with his louse
  std::optional<Lesson> lesson_;
};

}  // namespace woodlouse::client
