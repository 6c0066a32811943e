// Heights for knots that have none, of a grid that is in memory as a whole: the soap film over each hole,
// held by its shore.
//
// Every missing knot becomes the mean of its neighbours in east, west, north and south (those that there
// are), each weighted by 1 / distance^2: the discrete Laplace equation, so a filled height lies between the
// lowest and the highest of the shore, and the grid's rim, where it is missing too, is level across.
//
// Solver: multigrid with a fixed course, because filled heights are ground that is simulated: 16 W-cycles of
// two Gauss-Seidel sweeps down and two up, knots in a fixed order, + - * / alone, no test of convergence.
// They start from a pyramid of means of 2 x 2 knots. A coarse knot takes part only where all nine fine knots
// around it are missing, so that no correction touches a shore. Cost: some 160 visits of a missing knot;
// memory while it runs: 23 bytes a knot of the grid, missing or not. Error against the exact solution, of the
// shore's relief: 1e-6, a lake full of islands 1e-4 (tests/terrain/harmonic_fill_test.cpp: holes up to 300
// knots across); more where dx and dy differ by more than a factor of 2: there a filled height is still a
// mean of its shore's.
#pragma once

#include <cstddef>
#include <vector>

namespace woodlouse::terrain {

/// Fills every non-finite height of `columns` heights a row; `dx`, `dy` > 0 [m] between knots.
/// REQUIRES whole rows, and at least one finite height.
void fill_harmonically(std::vector<double>& heights, std::size_t columns, double dx, double dy);

}  // namespace woodlouse::terrain
