// The order of the step, event by event: a few starts of what `woodlouse-lab precision --only orders`
// measures.
#include <catch2/catch.hpp>
#include <string>

#include "bench/lab/problems/convergence.h"

using namespace woodlouse;
using namespace woodlouse::lab;
using state::Method;

namespace {

constexpr std::size_t kStarts = 9;
constexpr std::size_t kAt60 = 2, kAt960 = 6;  // of kConvergenceRates
static_assert(kConvergenceRates[kAt60] == 60 && kConvergenceRates[kAt960] == 960);

double order_of_place(const Convergence& c) {
  return order_of(c.position.median, c.position.median_uncertainty);
}
double order_of_way(const Convergence& c) {
  return order_of(c.distance.median, c.distance.median_uncertainty);
}

/// Events whose steps are set by rules, not by the rate, over most of the rates.
bool is_ruled(const std::string& event) {
  return event == "a stop" || event == "hardly moving under friction" ||
         event == "the rim of the default core";
}

}  // namespace

TEST_CASE("on smooth ground walls, seams, flights, thrusts and a core's rim keep the method's order") {
  for (const Event& event : events()) {
    if (event.ground == "spline" || is_ruled(event.name)) continue;
    const auto ways = reference_ways(event, kStarts);
    REQUIRE(ways.size() == kStarts);
    const Convergence standard = convergence(event, Method::kStandard, ways);
    INFO(event.name << ", " << event.ground << ": " << standard.position.median[kAt60] << " m at 60 Hz");
    // The first step out of rest sees friction turn; at walls a few steps in a hundred are shorter at 60 Hz.
    const double least = event.name == "from rest under friction" ? 2.8 : event.name == "a wall" ? 3.6 : 3.8;
    CHECK(order_of_place(standard) > least);
    CHECK(order_of_way(standard) > 1.8);
    CHECK(standard.position.median[kAt60] < 5e-7);
    CHECK(order_of_place(convergence(event, Method::kCheap, ways)) > 1.8);
  }
}

TEST_CASE("where splines change their cell the default keeps order 2 about, and `precise` its own") {
  for (const Event& event : events()) {
    if (event.ground != "spline" || is_ruled(event.name)) continue;
    const auto ways = reference_ways(event, kStarts);
    REQUIRE(ways.size() == kStarts);
    const Convergence standard = convergence(event, Method::kStandard, ways);
    INFO(event.name << ": " << standard.position.median[kAt60] << " m at 60 Hz");
    // How the steps lie about a line is chance: over few starts a slope is known to half an order.
    CHECK(order_of_place(standard) > 1.4);
    CHECK(order_of_way(standard) > 1.8);
    CHECK(standard.position.median[kAt60] < 1e-5);
    CHECK(order_of_place(convergence(event, Method::kPrecise, ways)) >
          (event.name == "from rest under friction" ? 2.8 : 3.5));
  }
}

TEST_CASE("where rules set the step the error is small at every rate and falls with the rate in the end") {
  for (const Event& event : events()) {
    if (!is_ruled(event.name)) continue;
    const auto ways = reference_ways(event, kStarts);
    REQUIRE(ways.size() == kStarts);
    const Convergence standard = convergence(event, Method::kStandard, ways);
    INFO(event.name << ", " << event.ground);
    for (const double error : standard.position.median) CHECK(error < 2e-6);
    CHECK(standard.position.median[kAt960] < 0.5 * standard.position.median[kAt60]);
    CHECK(standard.distance.median[kAt60] < 1e-3);
    if (event.name == "a stop") CHECK(order_of_place(standard) > 1.7);
  }
}
