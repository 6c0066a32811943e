// A louse's fields by name, in the order of Louse: the columns of a keyframe's rows and of the
// wire's `all`, and what a difference is reported by.
#pragma once

#include <cstddef>
#include <string_view>

#include "shared/state/louse.h"

namespace woodlouse::state {

inline constexpr std::size_t kLouseFields = 15;

/// Calls visit(name, field) for each. The fields are uint32 or double; phase and thrust_kind are their enums.
/// L is a Louse, const or not.
template <typename L, typename Visit>
void visit_fields(L&& louse, const Visit& visit) {
  visit(std::string_view("id"), louse.id);
  visit(std::string_view("phase"), louse.phase);
  visit(std::string_view("x"), louse.position.x);
  visit(std::string_view("y"), louse.position.y);
  visit(std::string_view("vx"), louse.velocity.x);
  visit(std::string_view("vy"), louse.velocity.y);
  visit(std::string_view("heading_x"), louse.heading.x);
  visit(std::string_view("heading_y"), louse.heading.y);
  visit(std::string_view("tx"), louse.thrust.x);
  visit(std::string_view("ty"), louse.thrust.y);
  visit(std::string_view("flight_z"), louse.flight_z);
  visit(std::string_view("flight_vz"), louse.flight_vz);
  visit(std::string_view("distance"), louse.distance);
  visit(std::string_view("thrust_kind"), louse.thrust_kind);
  visit(std::string_view("ticks_left"), louse.thrust_ticks);
}

}  // namespace woodlouse::state
