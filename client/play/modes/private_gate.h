// A gate of one's own, where there are no rules: any map can be lapped. Nobody else knows of it, and the
// times are this client's own. Pure; time is an argument.
#pragma once

#include <optional>

#include "client/drawing/course/course.h"
#include "client/play/view_state.h"
#include "shared/core/clock.h"
#include "shared/rules/gate.h"

namespace woodlouse::client {

class PrivateGate {
 public:
  static constexpr double kWidth = 4.0;  ///< [m]

  /// Across the heading, where the louse is; its clock runs from now. A second one ends the first.
  void set(const LouseSample& louse, core::Vec2 heading, core::Time now);
  void forget() { *this = PrivateGate(); }

  /// The louse now. A lap that ended since the last call [s]. The map's images say where edges wrap.
  std::optional<double> observe(const LouseSample& louse, const rules::Images& images, core::Time now);

  [[nodiscard]] std::optional<GateMark> mark() const;
  /// Empty: there is no gate.
  [[nodiscard]] GoalLine line(core::Time now) const;
  [[nodiscard]] bool is_best() const { return best_ && last_ && *last_ <= *best_; }

 private:
  std::optional<map::Gate> gate_;
  std::optional<LouseSample> before_;
  core::Time before_at_{};
  core::Time began_{};
  std::optional<double> last_, best_;  ///< laps [s]
};

}  // namespace woodlouse::client
