#include "client/play/modes/ghosts.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "client/play/modes/ghost_file.h"
#include "client/play/modes/goal.h"
#include "shared/map/spawns.h"
#include "shared/match/ghost.h"
#include "shared/match/match.h"

namespace woodlouse::client {
namespace {

constexpr double kTickOfGhosts = 65536.0;  ///< a tick in moments
constexpr double kShortestDrive = 3.0;     // [s]

constexpr std::size_t kTrailPoints = 30;
constexpr double kTrailSpacings = 120.0;  ///< of a map's width

}  // namespace

void Ghosts::begin(std::shared_ptr<const map::Map> map, std::uint32_t tick_hz, state::Mode mode) {
  assert(map != nullptr && tick_hz > 0);
  const bool is_same = map_ != nullptr && map_->hash == map->hash && mode_ == mode && tick_hz_ == tick_hz;
  keep();
  if (!is_same) unkept_.clear();  // they are of another file
  map_ = std::move(map);
  tick_hz_ = tick_hz;
  mode_ = mode;
  records_.clear();
  own_trail_ = Trail(trail_spacing());
  const bool is_exact = map_->detail == map::Detail::kExact;
  if (folder_ && is_exact && mode == state::Mode::kRace)
    if (const auto author = read_author_ghost(*map_, tick_hz_)) add_run(std::nullopt, "author", *author);
  if (is_same) return;  // back on the line: own drives are still known
  last_.reset();
  best_.reset();
  if (is_exact) load();
}

bool Ghosts::add_record(const protocol::GhostLine& line) {
  if (map_ == nullptr || mode_ != state::Mode::kRace || map_->detail != map::Detail::kExact) return false;
  if (line.behavior != match::kBehavior || line.tick_hz != tick_hz_) return false;
  if (!match::why_no_ghost(*map_, tick_hz_, line.ghost).empty()) return false;
  add_run(line.run.board, line.run.name, line);
  return true;
}

void Ghosts::add_run(std::optional<protocol::Board> board, const std::string& name,
                     const protocol::GhostLine& line) {
  const map::RaceMode& race = *map_->definition.modes.race;
  const auto& spawns = race.spawns.empty() ? map_->definition.spawns : race.spawns;
  assert(line.ghost.spawn < spawns.size());
  OwnDrive drive{map::louse_at(spawns[line.ghost.spawn], 1), line.ghost.inputs, line.ghost.ticks, 0};
  std::erase_if(records_, [&board](const Record& record) { return record.board == board; });
  records_.push_back({board, name + " " + span_text(static_cast<std::int64_t>(line.run.time), tick_hz_),
                      static_cast<double>(line.start) / kTickOfGhosts,
                      GhostRun(*map_, tick_hz_, mode_, std::move(drive)), Trail(trail_spacing())});
  mark_doubles();
}

/// A run that stands on several boards, or is the author's, too, is shown once: by a board rather than by the
/// author.
void Ghosts::mark_doubles() {
  const auto is_same = [](const OwnDrive& a, const OwnDrive& b) {
    return a.ticks == b.ticks && a.start.position == b.start.position && a.inputs == b.inputs;
  };
  for (std::size_t i = 0; i < records_.size(); ++i) {
    records_[i].is_double = false;
    for (std::size_t j = 0; j < records_.size(); ++j) {
      const bool is_before = records_[i].board.has_value() == records_[j].board.has_value()
                                 ? j < i
                                 : records_[j].board.has_value();
      if (j != i && is_before && is_same(records_[i].run.drive(), records_[j].run.drive()))
        records_[i].is_double = true;
    }
  }
}

double Ghosts::trail_spacing() const {
  const terrain::Rectangle& d = map_->terrain->domain();
  return std::max(d.x_max - d.x_min, 1.0) / kTrailSpacings;
}

GhostMark Ghosts::mark(std::string name, const LouseSample& sample, Trail& trail) const {
  trail.add(sample.position);
  const auto& points = trail.points();
  const std::size_t shown = std::min(points.size(), kTrailPoints);
  return {std::move(name),
          sample.position,
          sample.heading,
          {points.end() - static_cast<std::ptrdiff_t>(shown), points.end()}};
}

bool Ghosts::is_better(GhostRun& a, GhostRun& b) const {
  if (mode_ == state::Mode::kRace) {
    const std::uint64_t of_a = a.drive().lap, of_b = b.drive().lap;
    return of_a < of_b;  // neither is without one: take_own
  }
  const std::uint32_t ticks = std::min(a.drive().ticks, b.drive().ticks);
  return a.distance_at(ticks) > b.distance_at(ticks);
}

void Ghosts::add_drive(OwnDrive drive) {
  if (map_ == nullptr || map_->detail != map::Detail::kExact || drive.ticks < kShortestDrive * tick_hz_)
    return;
  if (mode_ != state::Mode::kRoam && mode_ != state::Mode::kRace) return;  // others would be in its way
  if (!why_no_drive(*map_, tick_hz_, drive).empty()) return;
  if (folder_) {
    unkept_.push_back(drive);
    if (unkept_.size() > kMostGhostsKept) unkept_.erase(unkept_.begin());
    keep();
  }
  take_own(std::move(drive));
}

void Ghosts::keep() {
  if (!unkept_.empty() && keep_ghost_drives(*folder_, *map_, tick_hz_, mode_, unkept_)) unkept_.clear();
}

void Ghosts::take_own(OwnDrive drive) {
  last_.emplace(*map_, tick_hz_, mode_, drive);
  if (mode_ == state::Mode::kRace && drive.lap == 0) return;  // nothing in it that could be the best
  if (!best_ || is_better(*last_, *best_)) best_.emplace(*map_, tick_hz_, mode_, std::move(drive));
}

void Ghosts::load() {
  if (!folder_) return;
  for (OwnDrive& drive : read_ghost_drives(*folder_, *map_, tick_hz_, mode_)) take_own(std::move(drive));
}

std::string Ghosts::cycle() {
  switch (choice_) {
    case GhostChoice::kBest:
      choice_ = GhostChoice::kLast;
      return last_ ? "ghost: your last drive" : "ghost: your last drive, once you respawn (R)";
    case GhostChoice::kLast:
      choice_ = GhostChoice::kOff;
      return "ghosts off";
    case GhostChoice::kOff:
      choice_ = GhostChoice::kBest;
      if (best_ || !records_.empty()) return "ghosts: the best";
      return mode_ == state::Mode::kRace ? "ghosts: the best, once you drove a lap and respawn (R)"
                                         : "ghosts: the best, once you respawn (R)";
  }
  return {};
}

std::vector<GhostMark> Ghosts::marks(std::optional<double> since_spawn, std::int64_t run_start, double tick) {
  std::vector<GhostMark> marks;
  if (choice_ == GhostChoice::kOff) return marks;
  if (choice_ == GhostChoice::kBest) {
    // They wait where their clock began until yours does.
    const double running =
        run_start == 0 ? 0.0 : std::max(0.0, tick - static_cast<double>(run_start) / kTickOfGhosts);
    for (Record& record : records_)
      if (const auto sample = record.is_double ? std::nullopt : record.run.at(record.start + running))
        marks.push_back(mark(record.name, *sample, record.trail));
  }
  std::optional<GhostRun>& own = choice_ == GhostChoice::kBest ? best_ : last_;
  if (!own || !since_spawn) return marks;
  if (const auto sample = own->at(*since_spawn))
    marks.push_back(mark(choice_ == GhostChoice::kBest ? "your best" : "your last", *sample, own_trail_));
  return marks;
}

}  // namespace woodlouse::client
