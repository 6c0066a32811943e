#include "client/drawing/course/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace woodlouse::client {
namespace {

constexpr int kBehind = 4;  ///< columns

struct Post {
  double z = 0.0;
  bool is_outside = false;  ///< the map ends
  bool is_steep = false;    ///< uphill, more than a push climbs from rest
};

}  // namespace

double profile_reach(const Scene& scene) {
  assert(scene.terrain != nullptr);
  const terrain::Rectangle& d = scene.terrain->domain();
  return std::clamp(0.25 * std::max(d.x_max - d.x_min, d.y_max - d.y_min), 8.0, 40.0);
}

void draw_profile(const Scene& scene, const LouseMark& you, const Styles& styles, int rows,
                  PanelWriter& out) {
  assert(scene.terrain != nullptr && rows >= 3);
  const terrain::Rectangle& d = scene.terrain->domain();
  const int columns = out.width();
  assert(columns > kBehind);
  const double step = profile_reach(scene) / std::max(1, columns - kBehind);
  const double climbs = scene.course.climbs.value_or(1e9);
  std::vector<Post> posts;
  for (int i = 0; i < columns; ++i) {
    const core::Vec2 p = you.position + (step * (i - kBehind)) * you.ahead;
    Post post;
    post.is_outside = !d.contains(p.x, p.y);
    if (!post.is_outside) {
      const terrain::SurfaceSample s = scene.terrain->sample(p.x, p.y);
      post.z = s.z;
      post.is_steep = s.zx * you.ahead.x + s.zy * you.ahead.y > climbs;
    }
    posts.push_back(post);
  }
  double low = 1e300, high = -1e300;
  for (const Post& post : posts)
    if (!post.is_outside) low = std::min(low, post.z), high = std::max(high, post.z);
  if (low > high) low = high = 0.0;
  const double own = posts.at(kBehind).z + you.above;
  high = std::max(high, own);
  // Metres a row: all rows for what there is of relief, as a flat picture says nothing; never less than
  // 0.25 m, which would make hills of ripples. What is too steep is marked, however it looks. The top row is
  // the louse's, should it stand on the summit, or fly.
  const int ground_rows = rows - 2;
  const double row_height = std::max((high - low) / ground_rows, 0.25);
  const bool has_color = scene.look.color != ColorMode::kMono;
  const auto rows_below = [&](double z) {
    return 1 + static_cast<int>(std::floor((z - low) / row_height + 1e-9));
  };
  for (int row = 0; row < rows; ++row) {
    out.begin_row();
    const int level = rows - 1 - row;  // rows of ground that must lie below
    for (int i = 0; i < columns; ++i) {
      const Post& post = posts[static_cast<std::size_t>(i)];
      if (post.is_outside) continue;
      const int filled = rows_below(post.z);
      if (i == kBehind && level == rows_below(own)) {
        Style style = styles.strong;
        if (has_color) style.foreground = Color::of(louse_color(you.id, Owner::kYou, scene.look));
        out.text(i, "@", style);
      }
      if (level >= filled) continue;
      Style style = post.is_steep ? styles.warning : styles.dim;
      if (paints_pixels(scene.look)) {
        style.background = post.is_steep ? Color::of({176, 72, 58}) : Color::of({58, 74, 88});
        out.text(i, post.is_steep && level + 1 == filled ? "^" : " ", style);
      } else {
        out.text(i, level + 1 < filled ? ":" : post.is_steep ? "^" : "#", style);
      }
    }
  }
}

}  // namespace woodlouse::client
