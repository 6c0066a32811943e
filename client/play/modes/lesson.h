// The first minute: three things to do, each told until it was really done. Pure; time is an argument.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client/drawing/course/course.h"
#include "client/drawing/key_labels.h"
#include "client/play/modes/way_words.h"
#include "shared/core/clock.h"
#include "shared/core/vec2.h"

namespace woodlouse::client {

/// What a lesson sees of its pupil, each frame.
struct LessonFacts {
  core::Time now{};
  bool is_pushing = false;
  core::Vec2 heading{1.0, 0.0};  ///< that the next push has
  double slope_degrees = 0.0;    ///< along the way, uphill positive
  double height = 0.0;           ///< [m]
  double speed = 0.0;            ///< [m/s]
};

class Lesson {
 public:
  /// relief: between the map's highest and lowest place [m]; where that is little nobody can swing.
  explicit Lesson(double relief) : relief_(relief) {}

  /// Goes on to the next step once this one was done. True: another one begins, or it is over now.
  bool observe(const LessonFacts& facts);
  void skip() { step_ = Step::kOver; }

  /// Everything was done; praise may still stand there.
  [[nodiscard]] bool is_learnt() const { return step_ == Step::kPraise || step_ == Step::kOver; }
  [[nodiscard]] bool is_over() const { return step_ == Step::kOver; }
  /// What is to be done, in two lines; empty: it is over. towards: where the rules of play want the pupil,
  /// right and up in its picture; the first push by compass goes there. winds: of text, which has no picture.
  [[nodiscard]] std::vector<GoalLine> lines(const KeyLabels& keys = {}, core::Vec2 towards = {0.0, 1.0},
                                            Winds winds = Winds::kShort) const;

 private:
  enum class Step : std::uint8_t { kPush, kTurn, kSwing, kPraise, kOver };

  [[nodiscard]] bool is_done(const LessonFacts& facts, double seconds);
  void begin(Step step, const LessonFacts& facts);

  double relief_;
  Step step_ = Step::kPush;
  std::optional<LessonFacts> before_;
  core::Time begun_{};
  double pushed_ = 0.0;  ///< in this step, as it wants it [s]
  double turned_ = 0.0;  ///< [rad]
  double lowest_ = 0.0;  ///< since the push downhill [m]
};

}  // namespace woodlouse::client
