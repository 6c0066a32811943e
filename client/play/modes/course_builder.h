// From what is known of a game by rules to what a picture shows of it.
#pragma once

#include <cstdint>
#include <vector>

#include "client/drawing/scene.h"
#include "client/play/modes/goal.h"
#include "client/play/visible_lice.h"

namespace woodlouse::client {

/// The marks on the ground, the lines and the podium, as louse `facts.id` has to do with them.
Course course_of(const GoalFacts& facts);

/// The lice by what the mode ranks by, best first, with it in words: best run, points, held seconds, metres
/// travelled. Where only a part of the room is seen the mode's best, whoever they are, and you; without rules
/// those that are seen, without ranks.
std::vector<ScoreRow> score_rows(const Sight& sight);

/// What that is, for a title: "best run of the round"; empty: the distance travelled.
std::string measured_by(const Sight& sight);

}  // namespace woodlouse::client
