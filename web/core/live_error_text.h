// An error figure as the page is told of it.
#pragma once

#include "shared/match/live_error.h"

namespace woodlouse::web {

/// Answers with {"of_play" [m/s of play], "worst" [m], "worst_tick", "apart" [m], "apart_seconds"}, or null
/// before the first tick has counted.
void answer_error(const match::LiveError& error);

}  // namespace woodlouse::web
