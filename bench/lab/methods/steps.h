// What the laboratory (laboratory.h) chooses from, each function compiled in a file of its own.
#pragma once

#include <memory>

#include "bench/lab/methods/laboratory.h"
#include "shared/document/surface_catalogue.h"
#include "shared/physics/ground_steps.h"

namespace woodlouse::lab {

using Steps = std::unique_ptr<const physics::GroundSteps>;

/// With the exact equations, outright. Every integrator.
Steps exact_steps(const terrain::BicubicSpline& ground, Integrator integrator,
                  const physics::StepRules& rules);
Steps exact_steps(const terrain::FunctionSurface& ground, Integrator integrator,
                  const physics::StepRules& rules);
/// The same through one indirect call a sample; null: precise, which needs to see polynomial cells.
Steps exact_steps(const document::AnySurface& ground, Integrator integrator, const physics::StepRules& rules);
/// With the document's equations; null: verlet_q and verlet_q4, whose implicit kick they have not, and
/// precise. REQUIRES equations other than kSurface.
Steps document_steps(const document::AnySurface& ground, Equations equations, Integrator integrator,
                     const physics::StepRules& rules);

}  // namespace woodlouse::lab
