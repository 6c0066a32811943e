#include "server/metrics/scrape.h"

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <array>
#include <cassert>
#include <chrono>
#include <limits>
#include <utility>
#include <vector>

#include "shared/core/printable.h"

namespace woodlouse::server {
namespace {

double seconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }

prometheus::MetricType type_of(MetricKind kind) {
  if (kind == MetricKind::kCounter) return prometheus::MetricType::Counter;
  return kind == MetricKind::kGauge ? prometheus::MetricType::Gauge : prometheus::MetricType::Histogram;
}

/// names: of the family, "room, role".
prometheus::ClientMetric labelled(std::string_view names, std::array<std::string_view, 3> values) {
  constexpr std::string_view kBetween = ", ";
  prometheus::ClientMetric series;
  for (const std::string_view value : values) {
    if (names.empty()) break;
    const std::size_t end = std::min(names.size(), names.find(kBetween));
    series.label.push_back({std::string(names.substr(0, end)), core::printable(value)});
    names.remove_prefix(std::min(names.size(), end + kBetween.size()));
  }
  assert(names.empty());
  return series;
}

}  // namespace

struct Scrape::Families {
  std::vector<prometheus::MetricFamily> all;
};

Scrape::Scrape() : families_(std::make_unique<Families>()) {
  for (const FamilyEntry& entry : families())
    families_->all.push_back({std::string(entry.name), std::string(entry.help), type_of(entry.kind), {}});
  assert(families_->all.size() == kFamilyCount);
}

Scrape::~Scrape() = default;

void Scrape::add(Family family, double value, std::string_view first, std::string_view second,
                 std::string_view third) {
  const FamilyEntry& entry = entry_of(family);
  assert(entry.kind != MetricKind::kHistogram);
  prometheus::ClientMetric series = labelled(entry.labels, {first, second, third});
  (entry.kind == MetricKind::kCounter ? series.counter.value : series.gauge.value) = value;
  families_->all[static_cast<std::size_t>(family)].metric.push_back(std::move(series));
}

void Scrape::add(Family family, const DurationHistogram& durations, std::string_view label) {
  const FamilyEntry& entry = entry_of(family);
  assert(entry.kind == MetricKind::kHistogram);
  prometheus::ClientMetric series = labelled(entry.labels, {label, {}, {}});
  series.histogram.sample_count = durations.count();
  series.histogram.sample_sum = seconds(durations.sum());
  for (std::size_t k = 0; k < DurationHistogram::kBounds.size(); ++k)
    series.histogram.bucket.push_back({durations.count_within(k), seconds(DurationHistogram::kBounds[k])});
  series.histogram.bucket.push_back({durations.count(), std::numeric_limits<double>::infinity()});
  families_->all[static_cast<std::size_t>(family)].metric.push_back(std::move(series));
}

std::string Scrape::text() const {
  std::vector<prometheus::MetricFamily> with_series;
  for (const prometheus::MetricFamily& family : families_->all)
    if (!family.metric.empty()) with_series.push_back(family);
  return prometheus::TextSerializer().Serialize(with_series);
}

}  // namespace woodlouse::server
