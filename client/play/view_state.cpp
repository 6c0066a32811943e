#include "client/play/view_state.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace woodlouse::client {
namespace {

using protocol::Column;

constexpr double kJumpFactor = 4.0;  // a step this much longer than the speeds allow is no motion
constexpr double kJumpSlack = 1.0;   // [m], for lice near rest

bool jumped(const LouseSample& from, const LouseSample& to, double seconds) {
  const core::Vec2 way = to.position - from.position;
  const double speed =
      std::hypot(from.velocity.x, from.velocity.y) + std::hypot(to.velocity.x, to.velocity.y);
  return std::hypot(way.x, way.y) > kJumpFactor * speed * seconds + kJumpSlack;
}

core::Vec2 unit_or(core::Vec2 v, core::Vec2 otherwise) {
  const double length = std::hypot(v.x, v.y);
  return length > 1e-6 ? (1.0 / length) * v : otherwise;
}

Standing read_standing(const double* row, const std::vector<std::size_t>& places) {
  if (places.empty()) return {};
  const auto whole = [&](std::size_t k) { return static_cast<std::int64_t>(row[places[k]]); };
  return {whole(0), static_cast<std::uint32_t>(whole(1)), static_cast<std::uint32_t>(whole(2)), whole(3),
          whole(4)};
}

/// `places`: where in the row each of wanted_columns() stands.
LouseSample read_row(const double* row, const std::vector<std::size_t>& places) {
  LouseSample sample;
  sample.position = {row[places[1]], row[places[2]]};
  sample.velocity = {row[places[3]], row[places[4]]};
  sample.heading = unit_or({row[places[5]], row[places[6]]}, sample.heading);
  sample.distance = row[places[7]];
  sample.flight_z = row[places[8]];
  return sample;
}

void read_rows(const protocol::Frame& frame, const std::vector<std::size_t>& places,
               const std::vector<std::size_t>& standing_places, std::map<std::uint32_t, LouseSample>& lice) {
  for (std::size_t i = 0; i < frame.rows(); ++i) {
    const double* row = frame.values.data() + i * frame.columns;
    LouseSample& louse = lice[static_cast<std::uint32_t>(row[places[0]])];
    louse = read_row(row, places);
    louse.standing = read_standing(row, standing_places);
  }
}

/// Empty: not all are there.
std::vector<std::size_t> places_of(std::span<const Column> wanted_ones, const std::vector<Column>& columns) {
  std::vector<std::size_t> places;
  for (const Column wanted : wanted_ones) {
    const auto found = std::find(columns.begin(), columns.end(), wanted);
    if (found == columns.end()) return {};
    places.push_back(static_cast<std::size_t>(found - columns.begin()));
  }
  return places;
}

}  // namespace

const std::vector<Column>& wanted_columns() {
  static const std::vector<Column> columns = {Column::kId,       Column::kX,        Column::kY,
                                              Column::kVx,       Column::kVy,       Column::kHeadingX,
                                              Column::kHeadingY, Column::kDistance, Column::kFlightZ};
  return columns;
}

LouseSample between(const LouseSample& from, const LouseSample& target, double seconds, double fraction,
                    const Ways& ways) {
  LouseSample to = target;
  to.position = ways.beside(from.position, target.position);
  if (jumped(from, to, seconds)) return fraction < 1.0 ? from : target;
  const double t = fraction;
  const double h00 = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
  const double h10 = t * (1.0 - t) * (1.0 - t);
  const double h01 = t * t * (3.0 - 2.0 * t);
  const double h11 = t * t * (t - 1.0);
  LouseSample sample;
  sample.position = h00 * from.position + (h10 * seconds) * from.velocity + h01 * to.position +
                    (h11 * seconds) * to.velocity;
  sample.position = ways.place(sample.position);
  sample.velocity = (1.0 - t) * from.velocity + t * to.velocity;
  sample.heading = unit_or((1.0 - t) * from.heading + t * to.heading, to.heading);
  sample.distance = from.distance + t * (to.distance - from.distance);
  // Where it leaves or touches the ground between both, the nearer one says whether it flies.
  if (from.flight_z != 0.0 && to.flight_z != 0.0)
    sample.flight_z = from.flight_z + t * (to.flight_z - from.flight_z);
  else
    sample.flight_z = t < 0.5 ? from.flight_z : to.flight_z;
  sample.standing = from.standing;
  return sample;
}

ViewState::ViewState(std::uint32_t tick_hz, const std::vector<Column>& columns,
                     std::optional<protocol::Game> before)
    : tick_hz_(tick_hz),
      columns_(columns.size()),
      places_(places_of(wanted_columns(), columns)),
      standing_places_(places_of(protocol::kRulesColumns, columns)),
      before_(std::move(before)) {}

ViewState::Merge ViewState::merge(const protocol::Frame& frame) {
  if (places_.empty() || frame.columns != columns_) return Merge::kUnreadable;
  if (!snapshots_.empty() && frame.tick <= snapshots_.back().tick) return Merge::kStale;
  Snapshot snapshot{frame.tick, {}, frame.game};
  if (!frame.is_key) {
    if (!key_ || key_->tick != frame.base) return Merge::kMissingBase;
    snapshot.lice = key_->lice;
    snapshot.game = key_->game;
    if (snapshot.game && frame.game) protocol::apply(*snapshot.game, *frame.game);
    for (const std::uint32_t id : frame.gone) snapshot.lice.erase(id);
  }
  read_rows(frame, places_, standing_places_, snapshot.lice);
  if (frame.is_key) key_ = snapshot;
  show(std::move(snapshot));
  return Merge::kTaken;
}

void ViewState::show(Snapshot snapshot) {
  if (!snapshots_.empty() && snapshot.tick <= snapshots_.back().tick) return;
  snapshots_.push_back(std::move(snapshot));
  if (snapshots_.size() > kSnapshots) snapshots_.pop_front();
}

void ViewState::clear() {
  before_.reset();
  key_.reset();
  snapshots_.clear();
}

std::map<std::uint32_t, LouseSample> ViewState::at(double tick, const Ways& ways) const {
  if (snapshots_.empty()) return {};
  const auto after = std::find_if(snapshots_.begin(), snapshots_.end(), [tick](const Snapshot& snapshot) {
    return static_cast<double>(snapshot.tick) > tick;
  });
  if (after == snapshots_.begin()) return after->lice;
  const Snapshot& from = *(after - 1);
  std::map<std::uint32_t, LouseSample> result = from.lice;
  const double passed = (tick - static_cast<double>(from.tick)) / tick_hz_;
  if (after == snapshots_.end()) {
    for (auto& [id, louse] : result) {
      louse.position = ways.place(louse.position + std::min(passed, kExtrapolateSeconds) * louse.velocity);
    }
    return result;
  }
  const double seconds = static_cast<double>(after->tick - from.tick) / tick_hz_;
  for (auto& [id, louse] : result) {
    const auto next = after->lice.find(id);
    if (next != after->lice.end()) louse = between(louse, next->second, seconds, passed / seconds, ways);
  }
  return result;
}

}  // namespace woodlouse::client
