#include "client/play/modes/teacher.h"

#include <algorithm>
#include <utility>

#include "client/play/modes/ghost_file.h"
#include "client/play/scene_builder.h"

namespace woodlouse::client {
namespace {

constexpr const char* kMark = "lesson";

/// Between the highest and the lowest of a grid of places [m].
double relief_of(const terrain::Terrain& terrain) {
  constexpr int kPlaces = 24;
  const terrain::Rectangle& d = terrain.domain();
  double low = 1e300, high = -1e300;
  for (int i = 0; i <= kPlaces; ++i)
    for (int j = 0; j <= kPlaces; ++j) {
      const double z = terrain
                           .sample(d.x_min + (d.x_max - d.x_min) * i / kPlaces,
                                   d.y_min + (d.y_max - d.y_min) * j / kPlaces)
                           .z;
      low = std::min(low, z);
      high = std::max(high, z);
    }
  return high - low;
}

}  // namespace

Teacher::Teacher(std::filesystem::path data)
    : data_(std::move(data)), is_new_(!data_.empty() && !is_done(data_, kMark)) {}

bool Teacher::observe(const Sight& sight, core::Time now) {
  if (!is_new_ || sight.pilot == nullptr || sight.map == nullptr) return false;
  const LouseSample* you = sample_of(sight, sight.pilot->id());
  if (you == nullptr) return false;
  if (!lesson_) lesson_.emplace(relief_of(*sight.map->terrain));
  const terrain::SurfaceSample ground = ground_under(sight, you->position);
  const double speed = speed_in_space(ground, you->velocity);
  const double flat = std::hypot(you->velocity.x, you->velocity.y);
  LessonFacts facts;
  facts.now = now;
  facts.is_pushing = sight.pilot->steering().pushing(now);
  facts.heading = sight.pilot->steering().heading();
  facts.slope_degrees = flat > 0.05 ? slope_degrees(ground, (1.0 / flat) * you->velocity) : 0.0;
  facts.height = ground.z;
  facts.speed = speed;
  const bool has_changed = lesson_->observe(facts);
  if (has_changed && lesson_->is_learnt()) mark_done(data_, kMark);  // whoever leaves now has had it
  if (lesson_->is_over()) end();
  return has_changed;
}

bool Teacher::dismiss() {
  if (!lesson_) return false;
  mark_done(data_, kMark);
  end();
  return true;
}

void Teacher::end() {
  lesson_.reset();
  is_new_ = false;
}

std::vector<GoalLine> Teacher::lines(const KeyLabels& keys, core::Vec2 towards, Winds winds) const {
  return lesson_ ? lesson_->lines(keys, towards, winds) : std::vector<GoalLine>();
}

}  // namespace woodlouse::client
