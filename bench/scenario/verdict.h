// What came of the plays of a scenario: whether they agree with one another, with the file and with the
// register.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/scenario/golden_register.h"
#include "bench/scenario/play.h"
#include "shared/core/error.h"

namespace woodlouse::scenario {

/// The first tick at which one of the plays differs from the first of them; nothing when they agree.
/// REQUIRES plays of one scenario.
std::optional<core::Error> disagreement(std::span<const std::unique_ptr<Play>> plays);

/// Everything in which the file differs from what was played: its behavior, the first wrong or missing hash.
std::vector<core::Error> differences(const Scenario& scenario, const Play& played);

/// "name tick hash" for each of the ticks.
std::string table_of(const Play& played);

/// The file's text with this program's behavior and the hashes that were played.
std::string updated_text(const Scenario& scenario, const Play& played);

}  // namespace woodlouse::scenario
