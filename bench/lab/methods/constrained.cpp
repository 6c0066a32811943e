#include "bench/lab/methods/constrained.h"

#include <cassert>
#include <cmath>
#include <variant>

#include "bench/lab/methods/integrators.h"

namespace woodlouse::lab {
namespace {

struct Space {
  double x = 0.0, y = 0.0, z = 0.0;
  friend Space operator+(Space a, Space b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Space operator-(Space a, Space b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Space operator*(double k, Space a) { return {k * a.x, k * a.y, k * a.z}; }
};

double dot(Space a, Space b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The gradient of the constraint z - f(x, y).
Space normal_of(const terrain::SurfaceSample& s) { return {-s.zx, -s.zy, 1.0}; }

/// Puts `q` onto the surface along `direction`, by Newton's method; what it took of it is added to `amount`.
/// The surface where it ended.
template <typename Surface>
terrain::SurfaceSample put_on(const Surface& surface, Space& q, Space direction, double& amount) {
  constexpr int kMost = 20;
  constexpr double kClose = 4e-16;
  terrain::SurfaceSample s = surface.sample(q.x, q.y);
  for (int i = 0; i < kMost; ++i) {
    const double off = q.z - s.z;
    const double by = -off / dot(normal_of(s), direction);
    q = q + by * direction;
    amount += by;
    const bool is_close = std::abs(off) <= kClose * (1.0 + std::abs(q.z));
    if (is_close || !std::isfinite(off)) break;
    s = surface.sample(q.x, q.y);
  }
  return s;
}

template <typename Surface>
class Rattle {
 public:
  Rattle(const Surface& surface, double gravity, const physics::Motion& start)
      : surface_(surface),
        force_{0.0, 0.0, -gravity},
        s_(surface.sample(start.position.x, start.position.y)) {
    q_ = {start.position.x, start.position.y, s_.z};
    v_ = {start.velocity.x, start.velocity.y, s_.zx * start.velocity.x + s_.zy * start.velocity.y};
  }

  void step(double h) {
    const Space normal = normal_of(s_);
    const Space before = q_;
    double amount = 0.5 * h * h * load_;  // as the last one, to begin with
    q_ = q_ + h * v_ + (0.5 * h * h) * force_ + amount * normal;
    s_ = put_on(surface_, q_, normal, amount);
    load_ = amount / (0.5 * h * h);
    v_ = (1.0 / h) * (q_ - before) + (0.5 * h) * force_;
    const Space here = normal_of(s_);
    v_ = v_ - (dot(here, v_) / dot(here, here)) * here;
  }

  void step4(double h) {
    for (const double part : kPartsOfOrder4) step(part * h);
  }

  [[nodiscard]] Space place() const { return q_; }
  [[nodiscard]] const terrain::SurfaceSample& sample() const { return s_; }
  /// What the constraint's force is of the normal, by the exact equations.
  [[nodiscard]] double exact_load() const {
    const double bend = s_.zxx * v_.x * v_.x + 2.0 * s_.zxy * v_.x * v_.y + s_.zyy * v_.y * v_.y;
    const Space normal = normal_of(s_);
    return (bend - dot(normal, force_)) / dot(normal, normal);
  }

 private:
  const Surface& surface_;
  Space force_, q_, v_;
  terrain::SurfaceSample s_;
  double load_ = 0.0;
};

template <typename Surface>
class RattleMotion final : public ConstrainedMotion {
 public:
  RattleMotion(const Surface& surface, bool is_composed, double gravity, const physics::Motion& start,
               double h)
      : motion_(surface, gravity, start), is_composed_(is_composed), h_(h) {}
  void step() override { is_composed_ ? motion_.step4(h_) : motion_.step(h_); }
  [[nodiscard]] core::Vec2 position() const override { return {motion_.place().x, motion_.place().y}; }

 private:
  Rattle<Surface> motion_;
  bool is_composed_;
  double h_;
};

/// Keeps the last four places, and the loads of those before the last; the last one's is what puts the next
/// place onto the surface.
template <typename Surface>
class Symmetric4 final : public ConstrainedMotion {
 public:
  Symmetric4(const Surface& surface, double gravity, const physics::Motion& start, double h)
      : surface_(surface), force_{0.0, 0.0, -gravity}, h_(h) {
    constexpr int kParts = 64;
    Rattle<Surface> begin(surface, gravity, start);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      for (int part = 0; k > 0 && part < kParts; ++part) begin.step4(h / kParts);
      places_[k] = begin.place();
      accelerations_[k] = force_ + begin.exact_load() * normal_of(begin.sample());
      last_ = begin.sample();
      load_ = begin.exact_load();
    }
  }

  void step() override {
    if (begun_ + 1 < places_.size()) {  // made at the beginning
      ++begun_;
      return;
    }
    const double k = h_ * h_ / 6.0;
    const Space normal = normal_of(last_);
    const Space direction = (7.0 * k) * normal;
    double load = load_;
    Space q = 2.0 * (places_[3] - places_[2] + places_[1]) - places_[0] +
              k * (7.0 * accelerations_[1] - 2.0 * accelerations_[2] + 7.0 * (force_ + load * normal));
    last_ = put_on(surface_, q, direction, load);
    accelerations_ = {accelerations_[1], accelerations_[2], force_ + load * normal, {}};
    load_ = load;
    places_ = {places_[1], places_[2], places_[3], q};
  }

  [[nodiscard]] core::Vec2 position() const override {
    const Space& q = places_[begun_];
    return {q.x, q.y};
  }

 private:
  const Surface& surface_;
  Space force_;
  double h_;
  std::array<Space, 4> places_;
  std::array<Space, 4> accelerations_;  ///< the last is not known yet
  terrain::SurfaceSample last_;         ///< where the last place is
  double load_ = 0.0;                   ///< a guess of the last place's
  std::size_t begun_ = 0;
};

template <typename Surface>
std::unique_ptr<ConstrainedMotion> make(const Surface& surface, Constrained method, double gravity,
                                        const physics::Motion& start, double h) {
  if (method == Constrained::kSymmetric4)
    return std::make_unique<Symmetric4<Surface>>(surface, gravity, start, h);
  return std::make_unique<RattleMotion<Surface>>(surface, method == Constrained::kRattle4, gravity, start, h);
}

}  // namespace

std::string_view to_text(Constrained method) {
  switch (method) {
    case Constrained::kRattle:
      return "rattle";
    case Constrained::kRattle4:
      return "rattle4";
    default:
      return "symmetric4";
  }
}

std::unique_ptr<ConstrainedMotion> make_constrained(const document::AnySurface& surface, Constrained method,
                                                    double gravity, const physics::Motion& start, double h) {
  assert(h > 0.0 && gravity >= 0.0);
  if (const auto* spline = std::get_if<terrain::BicubicSpline>(&surface))
    return make(*spline, method, gravity, start, h);
  assert(std::holds_alternative<terrain::FunctionSurface>(surface));
  return make(std::get<terrain::FunctionSurface>(surface), method, gravity, start, h);
}

}  // namespace woodlouse::lab
