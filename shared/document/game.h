// The paper's own simulation as a room plays it: its equations by False Euler, over its surfaces and ours,
// with walls and thrust, and with a speed that is kept finite. Nobody sticks and nobody rests, and energy
// comes and goes: what docs/physics.md promises of both does not hold here. Finite, inside and the same bits
// everywhere it is.
#pragma once

#include <memory>

#include "shared/document/surface_catalogue.h"
#include "shared/physics/ground_steps.h"
#include "shared/terrain/shared_surface.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::document {

/// [m/s] over the map. What False Euler makes of a cliff is cut to it, the direction kept.
inline constexpr double kMaxGameSpeed = 1000.0;

/// One of the paper's surfaces, as a terrain holds it.
std::shared_ptr<const terrain::AbstractSurface> as_terrain(std::shared_ptr<const AnySurface> surface);

/// The steps of rules.parameters.equations. `ground` must outlive them. REQUIRES equations of the paper, no
/// central gravity, lice that never leave the surface, and a terrain that is not tiled. Without lanes: a
/// batch of width 0.
std::unique_ptr<const physics::GroundSteps> make_game_steps(const terrain::Terrain& ground,
                                                            const physics::StepRules& rules);
/// The same over one of the paper's surfaces: biquadratic, blended, blended_document, gauss,
/// natural_document.
std::unique_ptr<const physics::GroundSteps> make_game_steps(const AnySurface& ground,
                                                            const physics::StepRules& rules);

}  // namespace woodlouse::document
