#include <array>

#include "shared/json/text.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {

static_assert(kValueRoom == json::kNumberRoom);

namespace {

// Exact: the quanta are powers of two.
const std::array<double, kColumnCount> kPerQuantum = [] {
  std::array<double, kColumnCount> result{};
  for (std::size_t i = 0; i < kColumnCount; ++i) result[i] = 1.0 / quantum(static_cast<Column>(i));
  return result;
}();

}  // namespace

char* write_value(char* to, double value, Column column, Format format) {
  if (format == Format::kExact) return json::write_double(to, value);
  return write_quantized(to, value, kPerQuantum[static_cast<std::size_t>(column)]);
}

}  // namespace woodlouse::protocol
