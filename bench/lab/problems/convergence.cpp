#include "bench/lab/problems/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/lab/problems/motion.h"

namespace woodlouse::lab {
namespace {

constexpr double kRounding = 1e-12;  // [m], of ways of some metres in up to some thousand steps
constexpr int kLeastRate = 60;       // [Hz]
constexpr int kTries = 1'000'000;

struct MedianAndWorst {
  double median, worst;
};

MedianAndWorst of(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors.back()};
}

void add(Spread& spread, std::size_t rate, std::vector<double> errors) {
  const auto [median, worst] = of(std::move(errors));
  spread.median[rate] = median;
  spread.worst[rate] = worst;
}

void add_uncertainty(Spread& spread, std::vector<double> differences) {
  const auto [median, worst] = of(std::move(differences));
  spread.median_uncertainty = median;
  spread.worst_uncertainty = worst;
}

double place_apart(const state::Louse& a, const state::Louse& b) { return distance(a.position, b.position); }
double way_apart(const state::Louse& a, const state::Louse& b) { return std::fabs(a.distance - b.distance); }

}  // namespace

std::vector<ReferenceWay> reference_ways(const Event& event, std::size_t count) {
  std::vector<ReferenceWay> ways;
  core::Random random(5);
  for (int i = 0; i < kTries && ways.size() < count; ++i) {
    const state::Louse start = event.start(random);
    const std::uint64_t whims = random.next();
    const Arrival end = arrival(event, state::Method::kPrecise, start, whims, kReferenceRate);
    if (!event.is_met(end.met)) continue;
    const Arrival half = arrival(event, state::Method::kPrecise, start, whims, kReferenceRate / 2);
    ways.push_back({start, whims, end.louse, half.louse});
  }
  return ways;
}

Convergence convergence(const Event& event, state::Method method, const std::vector<ReferenceWay>& ways) {
  Convergence result;
  std::vector<double> place_differences, length_differences;
  for (const ReferenceWay& way : ways) {
    place_differences.push_back(place_apart(way.end, way.end_at_half_rate));
    length_differences.push_back(way_apart(way.end, way.end_at_half_rate));
  }
  add_uncertainty(result.position, std::move(place_differences));
  add_uncertainty(result.distance, std::move(length_differences));
  for (std::size_t rate = 0; rate < kConvergenceRates.size(); ++rate) {
    std::vector<double> places, lengths;
    for (const ReferenceWay& way : ways) {
      const Arrival end = arrival(event, method, way.start, way.whims, kConvergenceRates[rate]);
      places.push_back(place_apart(end.louse, way.end));
      lengths.push_back(way_apart(end.louse, way.end));
      result.sub_steps[rate] += end.sub_steps / static_cast<double>(ways.size());
    }
    add(result.position, rate, std::move(places));
    add(result.distance, rate, std::move(lengths));
  }
  return result;
}

double order_of(const Errors& errors, double uncertainty) {
  double n = 0.0, x_sum = 0.0, y_sum = 0.0, xx_sum = 0.0, xy_sum = 0.0;
  for (std::size_t rate = 0; rate < errors.size(); ++rate) {
    if (kConvergenceRates[rate] < kLeastRate) continue;
    if (!(errors[rate] > 3.0 * uncertainty && errors[rate] > kRounding)) continue;
    const double x = std::log(static_cast<double>(kConvergenceRates[rate]));
    const double y = std::log(errors[rate]);
    n += 1.0;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  if (n < 2.0) return std::numeric_limits<double>::quiet_NaN();
  return -(n * xy_sum - x_sum * y_sum) / (n * xx_sum - x_sum * x_sum);
}

}  // namespace woodlouse::lab
