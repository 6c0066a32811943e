// Energy, walls and numbers on the maps as they are played: over force, contact and method.
#pragma once

#include <filesystem>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Every map of `folder` (empty: the project's own) within its own walls, under both contacts, by the rooms'
/// methods and the rivals, at 15 to 1000 Hz: with no force but gravity, with the map's own drag and friction,
/// braked, pushed. Gained is energy that nobody gave, of that above the map's lowest place: above the start
/// where nothing takes any, above the least so far where something does, and above what a push can have given
/// along the way. Writes lab-stability-maps.csv and draws the worst of the maps.
core::Expected<void> measure_game_stability(const std::filesystem::path& folder, const Output& output);

}  // namespace woodlouse::lab
