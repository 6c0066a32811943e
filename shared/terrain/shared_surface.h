// A surface behind an indirect call, for those that terrain does not know: of the paper (document/), of a
// test.
#pragma once

#include <cassert>
#include <memory>
#include <utility>

#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

/// Immutable: any thread may sample it. One without a Hessian leaves kNoHessian in its samples.
class AbstractSurface {
 public:
  AbstractSurface() = default;
  AbstractSurface(const AbstractSurface&) = delete;
  AbstractSurface& operator=(const AbstractSurface&) = delete;
  virtual ~AbstractSurface() = default;

  [[nodiscard]] virtual SurfaceSample sample(double x, double y) const = 0;
  [[nodiscard]] virtual Rectangle domain() const = 0;
  [[nodiscard]] virtual double cell() const = 0;
};

/// Meets Surface. Whoever steps many lice has steps of its own for what is behind it (physics::World).
class SharedSurface {
 public:
  static constexpr bool has_hessian = false;  ///< not all have one

  explicit SharedSurface(std::shared_ptr<const AbstractSurface> surface) : surface_(std::move(surface)) {
    assert(surface_ != nullptr);
  }

  [[nodiscard]] SurfaceSample sample(double x, double y) const { return surface_->sample(x, y); }
  [[nodiscard]] Rectangle domain() const { return surface_->domain(); }
  [[nodiscard]] double cell() const { return surface_->cell(); }

 private:
  std::shared_ptr<const AbstractSurface> surface_;
};

}  // namespace woodlouse::terrain
