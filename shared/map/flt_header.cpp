#include "shared/map/flt_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "shared/core/joined.h"
#include "shared/json/decimal_number.h"
#include "shared/json/text.h"
#include "shared/map/esri_header.h"

namespace woodlouse::map {
namespace {

constexpr double kMaxSide = 1e6;  ///< knots each way

constexpr std::array<std::string_view, 22> kKeys = {
    "ncols",  "nrows",  "xllcorner", "xllcenter",    "yllcorner",     "yllcenter",   "cellsize", "ulxmap",
    "ulymap", "xdim",   "ydim",      "nodata_value", "nodata",        "byteorder",   "nbits",    "pixeltype",
    "nbands", "layout", "skipbytes", "bandrowbytes", "totalrowbytes", "bandgapbytes"};

struct FltEntry {
  std::string key;    ///< lower case
  std::string value;  ///< lower case
  std::size_t line;
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kSpace = " \t\r\f\v";
  for (std::size_t begin = line.find_first_not_of(kSpace); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpace, end);
  }
  return words;
}

std::string place(const std::string& source, const FltEntry& entry) {
  return source + ":" + std::to_string(entry.line) + ": " + entry.key;
}

core::Expected<std::vector<FltEntry>> read_entries(std::string_view text, const std::string& source) {
  std::vector<FltEntry> entries;
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::vector<std::string_view> words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (words.empty()) continue;
    const std::string where = source + ":" + std::to_string(number);
    if (words.size() != 2) return core::fail(where, "is no key and value", "as in: ncols 10001");
    FltEntry entry{lower_case(words[0].substr(0, 32)), lower_case(words[1].substr(0, 64)), number};
    if (std::find(kKeys.begin(), kKeys.end(), entry.key) == kKeys.end()) {
      return core::fail(where, core::joined({"\"", json::shown(entry.key), "\" is no header key"}),
                        "a float grid has ncols, nrows, xllcorner, "
                        "yllcorner, cellsize, NODATA_value, byteorder");
    }
    for (const FltEntry& other : entries) {
      if (other.key == entry.key) return core::fail(place(source, entry), "stands twice", "keep one of them");
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

/// Looks keys up and collects the first thing that is wrong.
class FltKeys {
 public:
  FltKeys(std::vector<FltEntry> entries, std::string source)
      : entries_(std::move(entries)), source_(std::move(source)) {}

  [[nodiscard]] const FltEntry* find(std::string_view key) const {
    for (const FltEntry& entry : entries_) {
      if (entry.key == key) return &entry;
    }
    return nullptr;
  }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }

  double number(std::string_view key, double min, double max, std::string_view range) {
    const FltEntry* entry = find(key);
    if (entry == nullptr) {
      complain(source_, std::string(key) + " is missing", {});
      return min;
    }
    double value = 0.0;
    const char* end = entry->value.data() + entry->value.size();
    const auto [stop, error] = json::read_decimal(entry->value.data(), end, value);
    if (error != std::errc{} || stop != end) {
      complain(place(source_, *entry), core::joined({"\"", json::shown(entry->value), "\" is no number"}),
               {});
      return min;
    }
    if (!(value >= min && value <= max)) {
      complain(place(source_, *entry), "is not within " + std::string(range), {});
      return min;
    }
    return value;
  }
  std::size_t count(std::string_view key) {
    const double value = number(key, 4.0, kMaxSide, "4 to 1000000");
    if (std::floor(value) != value) complain(place(source_, *find(key)), "is no whole number", {});
    return static_cast<std::size_t>(value);
  }
  /// The key, if it stands there, has this value.
  void demand(std::string_view key, std::initializer_list<std::string_view> allowed, std::string hint) {
    const FltEntry* entry = find(key);
    if (entry == nullptr || std::find(allowed.begin(), allowed.end(), entry->value) != allowed.end()) return;
    complain(place(source_, *entry), core::joined({"\"", json::shown(entry->value), "\" can't be read"}),
             std::move(hint));
  }
  void complain(std::string where, std::string what, std::string hint) {
    if (!error_) error_ = core::Error{std::move(where), std::move(what), std::move(hint)};
  }
  [[nodiscard]] const std::optional<core::Error>& error() const { return error_; }
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  std::vector<FltEntry> entries_;
  std::string source_;
  std::optional<core::Error> error_;
};

double spacing(FltKeys& header, std::string_view own) {
  const std::string_view key = header.has(own) ? own : "cellsize";
  return header.number(key, std::numeric_limits<double>::min(), kMaxHeaderCoordinate, "above 0 to 1e9");
}

double coordinate(FltKeys& header, std::string_view key) {
  return header.number(key, -kMaxHeaderCoordinate, kMaxHeaderCoordinate, "-1e9 to 1e9");
}

/// The centre of the south-western cell along one axis. `from_upper` [m] from the upper left cell's centre to
/// it.
double origin(FltKeys& header, std::string_view corner, std::string_view center, std::string_view upper,
              double step, double from_upper) {
  const int given = int{header.has(corner)} + int{header.has(center)} + int{header.has(upper)};
  if (given > 1) {
    header.complain(
        header.source(),
        std::string(corner) + ", " + std::string(center) + " and " + std::string(upper) + " say the same",
        "keep one of them");
  }
  if (header.has(center)) return coordinate(header, center);
  if (header.has(upper)) return coordinate(header, upper) + from_upper;
  return coordinate(header, corner) + 0.5 * step;
}

void demand_plain_layout(FltKeys& header, std::size_t columns) {
  const std::string row_bytes = std::to_string(4 * columns);
  header.demand("nbits", {"32"}, "convert with gdal_translate -of EHdr -ot Float32");
  header.demand("pixeltype", {"float"}, "convert with gdal_translate -of EHdr -ot Float32");
  header.demand("nbands", {"1"}, "take one band with gdal_translate -b 1");
  header.demand("layout", {"bil", "bip", "bsq"}, "one band is the same in each of bil, bip, bsq");
  header.demand("skipbytes", {"0"}, "the data begin at the file's first byte");
  header.demand("bandrowbytes", {row_bytes}, "rows stand without gaps: 4 ncols bytes each");
  header.demand("totalrowbytes", {row_bytes}, "rows stand without gaps: 4 ncols bytes each");
  header.demand("bandgapbytes", {"0"}, "there is one band");
  header.demand("byteorder", {"lsbfirst", "i", "msbfirst", "m"}, "LSBFIRST or MSBFIRST");
}

float no_data_of(FltKeys& header) {
  const std::string_view key = header.has("nodata_value") ? "nodata_value" : "nodata";
  const FltEntry* entry = header.find(key);
  if (entry == nullptr || entry->value == "nan" || entry->value == "-nan")
    return std::numeric_limits<float>::quiet_NaN();
  const double value = header.number(key, -std::numeric_limits<double>::max(),
                                     std::numeric_limits<double>::max(), "the finite numbers");
  // Beyond a float's range is beyond kNoFloatHeightFrom too.
  return std::fabs(value) >= 1e30 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value);
}

}  // namespace

core::Expected<FltHeader> parse_flt_header(std::string_view text, const std::string& source) {
  auto entries = read_entries(text, source);
  if (!entries) return tl::unexpected(std::move(entries.error()));
  FltKeys header(std::move(*entries), source);
  FltHeader result;
  terrain::GridFrame& frame = result.frame;
  frame.columns = header.count("ncols");
  frame.rows = header.count("nrows");
  frame.dx = spacing(header, "xdim");
  frame.dy = spacing(header, "ydim");
  frame.x_origin = origin(header, "xllcorner", "xllcenter", "ulxmap", frame.dx, 0.0);
  frame.y_origin = origin(header, "yllcorner", "yllcenter", "ulymap", frame.dy,
                          -static_cast<double>(frame.rows - 1) * frame.dy);
  demand_plain_layout(header, frame.columns);
  result.no_data = no_data_of(header);
  result.declares_no_data = header.has("nodata_value") || header.has("nodata");
  if (const FltEntry* order = header.find("byteorder")) {
    if (order->value == "msbfirst" || order->value == "m") result.byte_order = ByteOrder::kBigEndian;
  }
  if (header.error()) return tl::unexpected(*header.error());
  return result;
}

}  // namespace woodlouse::map
