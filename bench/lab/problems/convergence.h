// How fast the error of an event's ways falls with the rate: the order of a method, event by event.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bench/lab/problems/events.h"

namespace woodlouse::lab {

inline constexpr std::array kConvergenceRates = {15, 30, 60, 120, 240, 480, 960};  // [Hz]
/// At which the reference runs, by `precise`, which locates the lines of knots [Hz].
inline constexpr int kReferenceRate = 7680;

/// An error at each of kConvergenceRates [m].
using Errors = std::array<double, kConvergenceRates.size()>;

/// Over all starts.
struct Spread {
  Errors median{}, worst{};
  double median_uncertainty = 0.0,
         worst_uncertainty = 0.0;  ///< what halving the reference's rate changes [m]
};

struct Convergence {
  Spread position, distance;  ///< of the place, of the length of the way
  Errors sub_steps{};         ///< a tick
};

/// A start that meets its event, and where its way really ends.
struct ReferenceWay {
  state::Louse start;
  std::uint64_t whims;
  state::Louse end, end_at_half_rate;
};

/// The first `count` starts that meet the event, at a million tries at most.
std::vector<ReferenceWay> reference_ways(const Event& event, std::size_t count);
Convergence convergence(const Event& event, state::Method method, const std::vector<ReferenceWay>& ways);

/// The slope of the logarithm of the error over that of the rate, by least squares: from 60 Hz on, below
/// which the rules of sub-steps set the step, and of what stands three times above the reference's
/// uncertainty and above rounding. NaN: fewer than two rates do.
double order_of(const Errors& errors, double uncertainty);

}  // namespace woodlouse::lab
