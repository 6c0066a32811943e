// The one list of a louse's fields: what the state hash covers, byte for byte and in this order; the columns
// of a keyframe's rows and of the wire's `all`; what a difference is reported by; Python's table (a test
// compares them).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "shared/state/louse.h"

namespace woodlouse::state {

struct LouseField {
  std::string_view name;      ///< on the wire, in recordings and in messages
  std::string_view unit;      ///< empty: none
  double quantum = 1.0;       ///< a quantized row carries integers, multiples of this; a power of two
  std::size_t offset = 0;     ///< in Louse [bytes]
  std::size_t size = 0;       ///< 4: an unsigned integer (or an enumeration of one), 8: a double
  std::uint32_t largest = 0;  ///< of an integer
};

inline constexpr double kCoordinateQuantum = 0x1p-10;
inline constexpr std::uint32_t kAnyInteger = 0xffff'ffff;

// clang-format off
inline constexpr std::array kLouseFields = {
    LouseField{"id",          "",      1.0,                offsetof(Louse, id),           4, kAnyInteger},
    LouseField{"phase",       "",      1.0,                offsetof(Louse, phase),        4, 2},
    LouseField{"x",           "m",     kCoordinateQuantum, offsetof(Louse, position.x),   8},
    LouseField{"y",           "m",     kCoordinateQuantum, offsetof(Louse, position.y),   8},
    LouseField{"vx",          "m/s",   kCoordinateQuantum, offsetof(Louse, velocity.x),   8},
    LouseField{"vy",          "m/s",   kCoordinateQuantum, offsetof(Louse, velocity.y),   8},
    LouseField{"heading_x",   "",      kCoordinateQuantum, offsetof(Louse, heading.x),    8},
    LouseField{"heading_y",   "",      kCoordinateQuantum, offsetof(Louse, heading.y),    8},
    LouseField{"tx",          "",      kThrustQuantum,     offsetof(Louse, thrust.x),     8},
    LouseField{"ty",          "",      kThrustQuantum,     offsetof(Louse, thrust.y),     8},
    LouseField{"flight_z",    "m",     kCoordinateQuantum, offsetof(Louse, flight_z),     8},
    LouseField{"flight_vz",   "m/s",   kCoordinateQuantum, offsetof(Louse, flight_vz),    8},
    LouseField{"distance",    "m",     0x1p-7,             offsetof(Louse, distance),     8},
    LouseField{"thrust_kind", "",      1.0,                offsetof(Louse, thrust_kind),  4, 2},
    LouseField{"ticks_left",  "ticks", 1.0,                offsetof(Louse, thrust_ticks), 4, kAnyInteger},
};
// clang-format on

/// That the list is the louse: field after field, without gap or overlap, to the last byte.
constexpr bool fields_tile_the_louse() {
  std::size_t end = 0;
  for (const LouseField& field : kLouseFields) {
    if (field.offset != end || (field.size != 4 && field.size != 8)) return false;
    end += field.size;
  }
  return end == sizeof(Louse);
}
static_assert(fields_tile_the_louse());

constexpr bool holds_integer(const LouseField& field) { return field.size == 4; }

/// The field of that name, or null.
constexpr const LouseField* find_field(std::string_view name) {
  for (const LouseField& field : kLouseFields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

/// The field's value; an integer's too: 32 bits are exact.
inline double field_value(const Louse& louse, const LouseField& field) {
  const auto* place = reinterpret_cast<const unsigned char*>(&louse) + field.offset;
  if (holds_integer(field)) {
    std::uint32_t integer = 0;
    std::memcpy(&integer, place, sizeof integer);
    return integer;
  }
  double number = 0.0;
  std::memcpy(&number, place, sizeof number);
  return number;
}

/// REQUIRES for an integer's field a whole number from 0 to 2^32 - 1; whether an enumeration knows it is for
/// who read it to say (LouseField::largest).
inline void set_field(Louse& louse, const LouseField& field, double value) {
  auto* place = reinterpret_cast<unsigned char*>(&louse) + field.offset;
  if (holds_integer(field)) {
    assert(value >= 0.0 && value <= kAnyInteger);
    const auto integer = static_cast<std::uint32_t>(value);
    assert(integer == value);
    std::memcpy(place, &integer, sizeof integer);
  } else {
    std::memcpy(place, &value, sizeof value);
  }
}

/// A louse of its fields' values in the list's order, as rows of `all` carry them. As set_field().
inline Louse louse_of(std::span<const double> values) {
  assert(values.size() == kLouseFields.size());
  Louse louse;
  for (std::size_t k = 0; k < kLouseFields.size(); ++k) set_field(louse, kLouseFields[k], values[k]);
  return louse;
}

}  // namespace woodlouse::state
