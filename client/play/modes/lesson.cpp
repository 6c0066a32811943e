#include "client/play/modes/lesson.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace woodlouse::client {
namespace {

constexpr double kPush = 0.6;         ///< [s] of pushing
constexpr double kSpeed = 1.0;        ///< [m/s] that come of it
constexpr double kQuarter = 1.5;      ///< [rad], a quarter of a turn, a little less
constexpr double kDownhill = -2.0;    ///< [degrees]
constexpr double kSwingPush = 0.6;    ///< [s] of pushing downhill
constexpr double kHighestRise = 1.0;  ///< [m] to be climbed behind it
constexpr double kRiseOfRelief = 0.1;
constexpr double kLeastRelief = 1.0;  ///< [m]
constexpr std::chrono::seconds kPraiseFor{4};

const std::string& key_towards(core::Vec2 way, const KeyLabels& keys) {
  if (std::abs(way.x) > std::abs(way.y)) return way.x > 0.0 ? keys.right : keys.left;
  return way.y < 0.0 ? keys.down : keys.up;
}

/// Where each of the four keys pushes.
std::string four_ways(const KeyLabels& keys, Winds winds) {
  return winds == Winds::kSpoken
             ? keys.up + " north, " + keys.left + " west, " + keys.down + " south, " + keys.right + " east"
             : keys.up + " up  " + keys.left + " left  " + keys.down + " down  " + keys.right + " right";
}

}  // namespace

void Lesson::begin(Step step, const LessonFacts& facts) {
  step_ = step;
  begun_ = facts.now;
  pushed_ = turned_ = 0.0;
}

bool Lesson::is_done(const LessonFacts& facts, double seconds) {
  switch (step_) {
    case Step::kPush:
      if (facts.is_pushing) pushed_ += seconds;
      return pushed_ >= kPush && facts.speed >= kSpeed;
    case Step::kTurn: {
      const core::Vec2 was = before_->heading;
      turned_ += std::abs(std::atan2(core::cross(was, facts.heading), core::dot(was, facts.heading)));
      return turned_ >= kQuarter;
    }
    case Step::kSwing:
      if (facts.is_pushing && facts.slope_degrees < kDownhill && facts.speed > kSpeed) pushed_ += seconds;
      if (pushed_ < kSwingPush || facts.height < lowest_) lowest_ = facts.height;
      return pushed_ >= kSwingPush &&
             facts.height > lowest_ + std::min(kHighestRise, kRiseOfRelief * relief_);
    case Step::kPraise:
      return facts.now - begun_ >= kPraiseFor;
    case Step::kOver:
      break;
  }
  return false;
}

bool Lesson::observe(const LessonFacts& facts) {
  if (is_over()) return false;
  if (!before_) {
    before_ = facts;
    begin(Step::kPush, facts);
    return true;
  }
  const double seconds =
      std::clamp(std::chrono::duration<double>(facts.now - before_->now).count(), 0.0, 0.2);
  const bool is_done_now = is_done(facts, seconds);
  before_ = facts;
  if (!is_done_now) return false;
  switch (step_) {
    case Step::kPush:
      begin(Step::kTurn, facts);
      break;
    case Step::kTurn:
      begin(relief_ >= kLeastRelief ? Step::kSwing : Step::kPraise, facts);
      break;
    case Step::kSwing:
      begin(Step::kPraise, facts);
      break;
    case Step::kPraise:
    case Step::kOver:
      begin(Step::kOver, facts);
      break;
  }
  return true;
}

std::vector<GoalLine> Lesson::lines(const KeyLabels& keys, core::Vec2 towards, Winds winds) const {
  const std::string of = relief_ >= kLeastRelief ? "/3 " : "/2 ";
  const auto told = [&of](const std::string& head, const std::string& what, const std::string& how) {
    return std::vector<GoalLine>{
        {{head.substr(0, 1) + of + head.substr(1), Tone::kGoal}, {"  " + what, Tone::kStrong}},
        {{how, Tone::kUsual}, {"  Esc: no lesson", Tone::kDim}}};
  };
  switch (step_) {
    case Step::kPush:
      return keys.compass
                 ? told("1PUSH", "hold " + key_towards(towards, keys) + ", or tap it", four_ways(keys, winds))
                 : told("1PUSH", "hold " + keys.up + ", or tap it", "you are pushed where you head");
    case Step::kTurn:
      return keys.compass ? told("2TURN", keys.left + " and " + keys.right, "a curve: two keys at once")
                          : told("2TURN", keys.left + " and " + keys.right + ", a quarter round",
                                 "a push goes the new way");
    case Step::kSwing:
      return told("3SWING", "push while rolling DOWN", "speed climbs what no push can");
    case Step::kPraise:
      return {{{"WELL DONE", Tone::kGood}, {"  that is how it is driven", Tone::kStrong}},
              {{keys.help + " shows all keys, " + keys.view + " another view", Tone::kUsual}}};
    case Step::kOver:
      break;
  }
  return {};
}

}  // namespace woodlouse::client
