// A folder with an ESRI float grid and a map that names it, gone afterwards.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace woodlouse::tests {

class BigMapFiles {
 public:
  /// `name`: of the folder, one for each test case. columns x rows heights f(column, row from the south), a
  /// metre apart.
  template <typename F>
  BigMapFiles(const std::string& name, std::size_t columns, std::size_t rows, const F& f)
      : folder_(std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / ("big_map_" + name)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    write("hills.hdr",
          "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
              "\nxllcenter 300\nyllcenter -20\ncellsize 1\nNODATA_value -9999\nbyteorder LSBFIRST\n");
    std::string bytes;
    for (std::size_t j = rows; j-- > 0;) {
      for (std::size_t i = 0; i < columns; ++i) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(f(i, j)));
        for (int k = 0; k < 4; ++k)
          bytes.push_back(static_cast<char>(static_cast<unsigned char>(bits >> (8 * k))));
      }
    }
    write("hills.flt", bytes);
  }
  /// Rolling ground of 201 x 150 knots.
  explicit BigMapFiles(const std::string& name) : BigMapFiles(name, 201, 150, wave) {}
  ~BigMapFiles() { std::filesystem::remove_all(folder_); }
  BigMapFiles(const BigMapFiles&) = delete;
  BigMapFiles& operator=(const BigMapFiles&) = delete;

  static double wave(std::size_t i, std::size_t j) {
    return 2.0 * std::sin(0.11 * static_cast<double>(i)) * std::cos(0.07 * static_cast<double>(j));
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file(name);
  }
  /// The map file; `more`: further fields of the terrain, as in `,"storage":"tiles"`.
  [[nodiscard]] std::filesystem::path map(const std::string& more) const {
    return write("hills.json", R"({"name":"hills","terrain":{"file":"hills.flt")" + more + "}}");
  }
  /// Gives one height of the file another value.
  void alter(std::size_t column, std::size_t row_from_north, std::size_t columns, float height) const {
    std::fstream grid(file("hills.flt"), std::ios::binary | std::ios::in | std::ios::out);
    grid.seekp(static_cast<std::streamoff>(4 * (row_from_north * columns + column)));
    grid.write(reinterpret_cast<const char*>(&height), sizeof height);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace woodlouse::tests
