// The rules' state as bytes: what is hashed, and what a keyframe holds. Little-endian, without gaps.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace woodlouse::rules {

/// What a state is made of; a double as the bits it has.
template <typename T>
concept Stored = std::unsigned_integral<T> || std::same_as<T, std::int64_t> || std::same_as<T, double>;

class StateWriter {
 public:
  /// One behind the other, in one go: a state is written in every tick in which somebody has done something.
  template <Stored... T>
  void put(T... values) {
    static_assert(std::endian::native == std::endian::little);
    char raw[(sizeof values + ...)];
    char* at = raw;
    ((std::memcpy(at, &values, sizeof values), at += sizeof values), ...);
    bytes_.append(raw, sizeof raw);
  }

  void clear() { bytes_.clear(); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Of bytes from outside: what is missing reads as 0, and is_whole() says so.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral T>
  T get() {
    if (rest_.size() < sizeof(T)) {
      is_short_ = true;
      rest_ = {};
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < sizeof(T); ++k)
      value |= std::uint64_t{static_cast<unsigned char>(rest_[k])} << (8 * k);
    rest_.remove_prefix(sizeof(T));
    return static_cast<T>(value);
  }
  std::int64_t get_signed() { return static_cast<std::int64_t>(get<std::uint64_t>()); }
  double get_bits() { return std::bit_cast<double>(get<std::uint64_t>()); }
  /// How many records of so many bytes each follow; what more than the rest can hold is short.
  std::size_t get_count(std::size_t bytes_each) {
    const std::size_t count = get<std::uint32_t>();
    if (count <= rest_.size() / bytes_each) return count;
    is_short_ = true;
    rest_ = {};
    return 0;
  }

  /// All was there, and nothing is left.
  [[nodiscard]] bool is_whole() const { return !is_short_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool is_short_ = false;
};

}  // namespace woodlouse::rules
