// Prints frames for emulated_frames_test.py, which feeds them to a terminal emulator nobody here wrote:
//     frame COLUMNS ROWS MODE BYTES     then that many bytes: the difference to what is shown
// and then a line per row: the cells a terminal must show now, GLYPH/FG/BG/ATTRIBUTES in hex, space between.
// A colour is `-` (default) or six hex digits; for 16 colours the index.
#include <cstdio>
#include <string>

#include "client/drawing/compose.h"
#include "client/terminal/cell_diff.h"
#include "tests/client/drawing/staged_game.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace woodlouse::client::testing;

namespace {

std::string color_text(Color color, ColorMode mode) {
  const Color shown = quantise(color, mode);
  if (shown.kind == Color::Kind::kDefault) return "-";
  char text[8];
  const Rgb rgb = shown.kind == Color::Kind::kRgb ? shown.rgb : palette_color(shown.index());
  if (mode == ColorMode::k16)
    std::snprintf(text, sizeof text, "%d", shown.index());
  else
    std::snprintf(text, sizeof text, "%02x%02x%02x", rgb.r, rgb.g, rgb.b);
  return text;
}

void print(const CellBuffer& cells, ColorMode mode, const std::string& bytes) {
  std::printf("frame %d %d %d %zu\n", cells.size().columns, cells.size().rows, static_cast<int>(mode),
              bytes.size());
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  for (int row = 0; row < cells.size().rows; ++row) {
    for (int column = 0; column < cells.size().columns; ++column) {
      const Cell cell = whole_cell(cells.row(row), static_cast<std::size_t>(column));
      std::printf("%x/%s/%s/%x ", static_cast<unsigned>(cell.glyph),
                  color_text(cell.style.foreground, mode).c_str(),
                  color_text(cell.style.background, mode).c_str(), cell.style.attributes);
    }
    std::printf("\n");
  }
}

/// Changes some cells to anything that may stand in one.
void scribble(CellBuffer& cells, core::Random& random) {
  constexpr char32_t kGlyphs[] = {U' ',      U'a',      U'@',      U'#',      U'\u2580',     U'\u2584',
                                  U'\u00FC', U'\u0416', U'\u2500', U'\u6F22', U'\U0001F41B', U'\0'};
  if (cells.size().columns == 0 || cells.size().rows == 0) return;
  const auto below = [&](int n) { return static_cast<int>(random.next() % static_cast<std::uint64_t>(n)); };
  const auto color = [&]() -> Color {
    const auto byte = [&] { return static_cast<std::uint8_t>(below(4) * 80); };
    const int kind = below(3);
    if (kind == 0) return {};
    return kind == 1 ? Color::indexed(static_cast<std::uint8_t>(16 + below(240)))
                     : Color::of({byte(), byte(), byte()});
  };
  for (int n = below(120); n > 0; --n) {
    const Style style{color(), color(), static_cast<Attributes>(below(4))};
    const int row = below(cells.size().rows);
    const int first = below(cells.size().columns);
    for (int column = first; column <= first + below(6); ++column)
      cells.put(column, row, kGlyphs[below(12)], style);
  }
}

}  // namespace

int main() {
  core::Random random(2024);
  StagedGame game(named_terrain(terrain::FunctionName::kVolcano), 7, 5);
  for (const ColorMode mode : {ColorMode::kMono, ColorMode::k16, ColorMode::k256, ColorMode::kTruecolor}) {
    Composer composer;
    FrameEncoder encoder(mode);
    CellBuffer cells({80, 24});
    for (int frame = 0; frame < 60; ++frame) {
      const std::uint64_t dice = random.next() % 16;
      if (dice == 0)
        cells.resize({static_cast<int>(40 + random.next() % 90), static_cast<int>(10 + random.next() % 25)});
      if (dice == 1) encoder.invalidate();
      if (dice < 6) {
        scribble(cells, random);
      } else {
        Scene& scene = game.scene();
        scene.look = {mode, frame % 20 < 10 ? GlyphSet::kHalfBlocks : GlyphSet::kAscii};
        scene.view = static_cast<View>(frame / 8 % 4);
        scene.mode = static_cast<Mode>(dice == 7 ? frame % 6 : 0);
        game.advance();
        composer.draw(scene, cells);
      }
      print(cells, mode, encoder.encode(cells));
    }
  }
}
