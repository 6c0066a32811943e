#include "bench/lab/figures/scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace woodlouse::lab {
namespace {

double dot_of(const Place& a, const Place& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Place normal_of(double zx, double zy) {
  const double length = std::sqrt(1.0 + zx * zx + zy * zy);
  return {-zx / length, -zy / length, 1.0 / length};
}

Colour mixed(Colour a, Colour b, double share_of_b) {
  return {a.red + share_of_b * (b.red - a.red), a.green + share_of_b * (b.green - a.green),
          a.blue + share_of_b * (b.blue - a.blue)};
}

char byte_of(double part) {
  return static_cast<char>(static_cast<unsigned char>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))));
}

}  // namespace

Scene::Scene(std::size_t width, std::size_t height, std::size_t finer, const View& view)
    : view_(view),
      finer_(finer),
      columns_(width * finer),
      rows_(height * finer),
      fine_pixels_a_metre_(static_cast<double>(width * finer) / view.metres_across),
      colours_(columns_ * rows_),
      near_(columns_ * rows_, -std::numeric_limits<double>::infinity()) {
  assert(width >= 1 && height >= 1 && finer >= 1 && view.metres_across > 0.0);
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double ca = std::cos(view.azimuth * kDegree), sa = std::sin(view.azimuth * kDegree);
  const double ce = std::cos(view.elevation * kDegree), se = std::sin(view.elevation * kDegree);
  right_ = {-sa, ca, 0.0};
  up_ = {-se * ca, -se * sa, ce};
  towards_ = {ce * ca, ce * sa, se};
  // From the viewer's left and behind, low: so a small bend of the normal shows.
  const Place light{up_.x - 1.2 * right_.x, up_.y - 1.2 * right_.y, 1.7};
  const double length = std::sqrt(dot_of(light, light));
  light_ = {light.x / length, light.y / length, light.z / length};
}

Scene::Seen Scene::seen(const Place& place) const {
  const Place p{place.x - view_.centre.x, place.y - view_.centre.y,
                view_.heights_by * (place.z - view_.centre.z)};
  return {0.5 * static_cast<double>(columns_) + fine_pixels_a_metre_ * dot_of(p, right_),
          0.5 * static_cast<double>(rows_) + fine_pixels_a_metre_ * dot_of(p, up_), dot_of(p, towards_)};
}

std::optional<std::size_t> Scene::pixel_at(const Seen& at, long right, long up) const {
  const long column = std::lround(at.column) + right, row = std::lround(at.row) + up;
  if (column < 0 || row < 0 || column >= static_cast<long>(columns_) || row >= static_cast<long>(rows_))
    return std::nullopt;
  return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
}

bool Scene::is_behind(const Seen& at, std::size_t pixel) const {
  // A line lies on the very ground it is compared with, and its dots reach over a slope's next pixels.
  constexpr double kSlackPixels = 3.0;
  return at.near + kSlackPixels / fine_pixels_a_metre_ < near_[pixel];
}

bool Scene::hides(const Place& place) const {
  const Seen at = seen(place);
  const auto pixel = pixel_at(at, 0, 0);
  return pixel && is_behind(at, *pixel);
}

Colour Scene::lit(const terrain::SlopeSample& s, Colour colour) const {
  const Place n = normal_of(view_.heights_by * s.zx, view_.heights_by * s.zy);
  const double facing = dot_of(n, towards_);
  if (facing < 0.0) {
    constexpr double kDull = 0.6;
    const double brightness = kDull - (1.0 - kDull) * facing;
    return {0.62 * brightness, 0.66 * brightness, 0.74 * brightness};
  }
  const double diffuse = std::fmax(0.0, dot_of(n, light_));
  if (view_.stripes > 0.0) {
    const double angle = std::acos(std::fmin(1.0, diffuse)) * 180.0 / std::numbers::pi;
    return std::fmod(angle, 2.0 * view_.stripes) < view_.stripes ? colour : Colour{0.15, 0.15, 0.2};
  }
  constexpr double kAmbient = 0.15, kGloss = 0.3, kSharpness = 40.0;
  const Place half{light_.x + towards_.x, light_.y + towards_.y, light_.z + towards_.z};
  const double gloss = std::pow(std::fmax(0.0, dot_of(n, half) / std::sqrt(dot_of(half, half))), kSharpness);
  const double brightness = kAmbient + (1.0 - kAmbient) * diffuse;
  return mixed({brightness * colour.red, brightness * colour.green, brightness * colour.blue}, {},
               kGloss * gloss);
}

void Scene::fill(const Corner& a, const Corner& b, const Corner& c, const Heights& normals, Colour colour) {
  const double area = (b.seen.column - a.seen.column) * (c.seen.row - a.seen.row) -
                      (c.seen.column - a.seen.column) * (b.seen.row - a.seen.row);
  if (area == 0.0) return;
  const auto range = [](double p, double q, double r, std::size_t size) {
    const double last = static_cast<double>(size) - 1.0;
    return std::pair{std::clamp(std::floor(std::min({p, q, r})), 0.0, last),
                     std::clamp(std::ceil(std::max({p, q, r})), 0.0, last)};
  };
  const auto [left, right] = range(a.seen.column, b.seen.column, c.seen.column, columns_);
  const auto [low, high] = range(a.seen.row, b.seen.row, c.seen.row, rows_);
  constexpr double kSlack = -1e-9;  // pixels on an edge belong to both triangles, to none they must not
  for (double row = low; row <= high; row += 1.0) {
    for (double column = left; column <= right; column += 1.0) {
      const double of_b = ((column - a.seen.column) * (c.seen.row - a.seen.row) -
                           (c.seen.column - a.seen.column) * (row - a.seen.row)) /
                          area;
      const double of_c = ((b.seen.column - a.seen.column) * (row - a.seen.row) -
                           (column - a.seen.column) * (b.seen.row - a.seen.row)) /
                          area;
      const double of_a = 1.0 - of_b - of_c;
      if (of_a < kSlack || of_b < kSlack || of_c < kSlack) continue;
      const double near = of_a * a.seen.near + of_b * b.seen.near + of_c * c.seen.near;
      const std::size_t at = static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
      if (near <= near_[at]) continue;
      near_[at] = near;
      colours_[at] =
          lit(normals(of_a * a.x + of_b * b.x + of_c * c.x, of_a * a.y + of_b * b.y + of_c * c.y), colour);
    }
  }
}

void Scene::add_terrain(const terrain::Rectangle& domain, std::size_t mesh, const Heights& heights,
                        const Heights& normals, Colour colour) {
  assert(mesh >= 1);
  const auto corner = [&](std::size_t i, std::size_t j) {
    const double x =
        domain.x_min + (domain.x_max - domain.x_min) * static_cast<double>(i) / static_cast<double>(mesh);
    const double y =
        domain.y_min + (domain.y_max - domain.y_min) * static_cast<double>(j) / static_cast<double>(mesh);
    return Corner{seen({x, y, heights(x, y).z}), x, y};
  };
  for (std::size_t j = 0; j < mesh; ++j) {
    for (std::size_t i = 0; i < mesh; ++i) {
      const Corner south_west = corner(i, j), south_east = corner(i + 1, j);
      const Corner north_west = corner(i, j + 1), north_east = corner(i + 1, j + 1);
      fill(south_west, south_east, north_east, normals, colour);
      fill(south_west, north_east, north_west, normals, colour);
    }
  }
}

void Scene::dot(const Seen& at, double radius, Colour colour, Depth depth) {
  const long reach = std::lround(std::ceil(radius));
  for (long j = -reach; j <= reach; ++j) {
    for (long i = -reach; i <= reach; ++i) {
      if (static_cast<double>(i * i + j * j) > radius * radius) continue;
      const auto pixel = pixel_at(at, i, j);
      if (pixel && (depth == Depth::kIgnored || !is_behind(at, *pixel))) colours_[*pixel] = colour;
    }
  }
}

void Scene::add_line(const std::vector<Place>& points, Colour colour, double width, Depth depth) {
  const double radius = 0.5 * width * static_cast<double>(finer_);
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Seen a = seen(points[k - 1]), b = seen(points[k]);
    const double length = std::hypot(b.column - a.column, b.row - a.row);
    const auto pieces = static_cast<std::size_t>(std::ceil(length)) + 1;
    for (std::size_t i = 0; i <= pieces; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(pieces);
      dot({a.column + t * (b.column - a.column), a.row + t * (b.row - a.row), a.near + t * (b.near - a.near)},
          radius, colour, depth);
    }
  }
}

std::string Scene::plot() const {
  const std::size_t width = columns_ / finer_, height = rows_ / finer_;
  std::string bytes;
  bytes.reserve(3 * width * height);
  const double share = 1.0 / static_cast<double>(finer_ * finer_);
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      Colour mean{0.0, 0.0, 0.0};
      for (std::size_t j = 0; j < finer_; ++j) {
        for (std::size_t i = 0; i < finer_; ++i) {
          const Colour& fine = colours_[(row * finer_ + j) * columns_ + column * finer_ + i];
          mean = {mean.red + share * fine.red, mean.green + share * fine.green,
                  mean.blue + share * fine.blue};
        }
      }
      for (const double part : {mean.red, mean.green, mean.blue}) bytes += byte_of(part);
    }
  }
  std::ostringstream script;
  script << "set xrange [-0.5:" << width << "-0.5]\nset yrange [-0.5:" << height << "-0.5]\n"
         << "plot '-' binary array=(" << width << ',' << height
         << ") format='%uchar%uchar%uchar' using 1:2:3 with rgbimage notitle\n"
         << bytes << '\n';
  return script.str();
}

Heights facets_of(const terrain::HeightGrid& grid) {
  return [&grid](double x, double y) -> terrain::SlopeSample {
    const auto cell = [](double position, std::size_t knots) {
      return static_cast<std::size_t>(
          std::clamp(std::floor(position), 0.0, static_cast<double>(knots) - 2.0));
    };
    const double column = (x - grid.x_origin) / grid.dx, row = (y - grid.y_origin) / grid.dy;
    const std::size_t i = cell(column, grid.columns), j = cell(row, grid.rows);
    const double u = column - static_cast<double>(i), v = row - static_cast<double>(j);
    const double sw = grid.at(i, j), se = grid.at(i + 1, j), nw = grid.at(i, j + 1),
                 ne = grid.at(i + 1, j + 1);
    const double by_u = u > v ? se - sw : ne - nw;  // the diagonal runs from south-west to north-east
    const double by_v = u > v ? ne - se : nw - sw;
    return {sw + u * by_u + v * by_v, by_u / grid.dx, by_v / grid.dy};
  };
}

}  // namespace woodlouse::lab
