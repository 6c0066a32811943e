#include "shared/elevation/hgt_grid_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <string>

namespace woodlouse::elevation {
namespace {

constexpr std::int16_t kVoid = -32768;

/// So many digits from `at` on as a number; nothing: others stand there.
std::optional<int> digits(std::string_view name, std::size_t at, std::size_t count) {
  if (name.size() < at + count) return std::nullopt;
  int value = 0;
  for (const char c : name.substr(at, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

/// 1 or -1 by a letter of either case; nothing: it is neither.
std::optional<int> side(char letter, char positive, char negative) {
  const char upper = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  if (upper == positive) return 1;
  if (upper == negative) return -1;
  return std::nullopt;
}

}  // namespace

std::optional<core::Vec2> corner_of_name(std::string_view name) {
  if (name.size() < 7) return std::nullopt;
  const auto north = side(name[0], 'N', 'S');
  const auto latitude = digits(name, 1, 2);
  const auto east = side(name[3], 'E', 'W');
  const auto longitude = digits(name, 4, 3);
  if (!north || !latitude || !east || !longitude || *latitude > 90 || *longitude > 180) return std::nullopt;
  return core::Vec2{static_cast<double>(*east * *longitude), static_cast<double>(*north * *latitude)};
}

core::Expected<std::shared_ptr<const HgtGrid>> HgtGrid::open(core::InputFile file,
                                                             std::optional<core::Vec2> corner) {
  const std::string path = file.path().string();
  std::size_t side_knots = 0;
  for (const std::size_t side : {std::size_t{1201}, std::size_t{3601}}) {
    if (file.size() == 2 * side * side) side_knots = side;
  }
  if (side_knots == 0) {
    return core::fail(path, "has " + std::to_string(file.size()) + " bytes, which is no SRTM tile",
                      "2884802 bytes are one of 3 arc seconds, 25934402 one of 1 arc second");
  }
  if (!corner) corner = corner_of_name(file.path().filename().string());
  if (!corner) {
    return core::fail(path, "does not say by its name where it lies",
                      "call it like N47E011.hgt, or give its south-western corner: \"corner\": [11, 47]");
  }
  const double step = 1.0 / static_cast<double>(side_knots - 1);
  const terrain::GridFrame frame{side_knots, side_knots, corner->x, corner->y, step, step};
  return std::shared_ptr<const HgtGrid>(new HgtGrid(frame, std::move(file)));
}

void HgtGrid::read(std::size_t column, std::size_t row, std::span<double> out) const {
  assert(column + out.size() <= frame_.columns && row < frame_.rows);
  const std::size_t first = (frame_.rows - 1 - row) * frame_.columns + column;  // the north stands first
  std::array<std::byte, 8192> bytes;
  constexpr std::size_t kPart = bytes.size() / 2;
  for (std::size_t done = 0; done < out.size(); done += kPart) {
    const std::span<double> part = out.subspan(done, std::min(kPart, out.size() - done));
    const bool ok = file_.read_at(std::span(bytes).first(2 * part.size()), 2 * (first + done));
    if (!ok) read_failures_.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const auto raw = static_cast<std::uint16_t>((std::to_integer<unsigned>(bytes[2 * k]) << 8) |
                                                  std::to_integer<unsigned>(bytes[2 * k + 1]));
      const auto height = static_cast<std::int16_t>(raw);
      part[k] =
          ok && height != kVoid ? static_cast<double>(height) : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace woodlouse::elevation
