// Which line may follow which, and how many: what bounds the memory and the time that a recording can cost.
//
//     header, keyframe, { chat* step [keyframe] }*, chat*, [index, end]
//
// A step is the one that is due, a chat (or a pause) belongs to it, a keyframe shows where the steps led.
// Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "shared/core/error.h"
#include "shared/replay/format.h"

namespace woodlouse::replay {

/// What is said while one step is due. A server's limits on messages keep it below; a writer leaves out more.
inline constexpr std::size_t kMaxChatsAStep = 4096;
class LineOrder {
 public:
  /// The header was read: a keyframe has to follow. Without it, any line may be the first one seen.
  void begin();
  /// The next line, or as many steps as it stands for. Errors, without a place: it can't stand here.
  [[nodiscard]] core::Expected<void> follow(const Line& line);
  /// The end was read: nothing may follow.
  [[nodiscard]] bool is_over() const { return has_end_; }

 private:
  [[nodiscard]] core::Expected<void> step(std::uint64_t tick, std::uint64_t steps);
  [[nodiscard]] core::Expected<void> keyframe(std::uint64_t tick);
  [[nodiscard]] core::Expected<void> aside(const char* kind, std::uint64_t tick);
  [[nodiscard]] core::Expected<void> index(std::uint64_t tick);
  [[nodiscard]] core::Expected<void> end(std::uint64_t tick);

  bool wants_keyframe_ = false;
  std::optional<std::uint64_t> due_;  ///< the step that is to come; unknown before the first line
  std::uint64_t steps_ = 0;           ///< since the last keyframe
  std::size_t chats_ = 0;             ///< and pauses, since the last step
  bool has_keyframe_ = false;         ///< of the tick that is reached
  bool has_index_ = false;
  bool has_end_ = false;
};

}  // namespace woodlouse::replay
