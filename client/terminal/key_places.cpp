#include "client/terminal/key_places.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <string_view>

namespace woodlouse::client {
namespace {

struct Layout {
  std::u32string_view typed;
  std::u32string_view places;
};

// Rows of keys from left to right; where a key types ASCII, or two characters, it is left out.
constexpr std::array kLayouts = {
    Layout{U"йцукенгшщзхъфывапролджэячсмитьбюё", U"qwertyuiop[]asdfghjkl;'zxcvbnm,.`"},
    Layout{U"ЙЦУКЕНГШЩЗХЪФЫВАПРОЛДЖЭЯЧСМИТЬБЮЁ", U"qwertyuiop[]asdfghjkl;'zxcvbnm,.`"},
    Layout{U"іїєґІЇЄҐ", U"s]'\\s]'\\"},  // Ukrainian, where it differs
    Layout{U"ςερτυθιοπασδφγηξκλζχψωβνμ", U"wertyuiopasdfghjklzxcvbnm"},
    Layout{U"ΕΡΤΥΘΙΟΠΑΣΔΦΓΗΞΚΛΖΧΨΩΒΝΜ", U"ertyuiopasdfghjklzxcvbnm"},
    Layout{U"קראטוןםפשדגכעיחלךףזסבהנמצתץ", U"ertyuiopasdfghjkl;zxcvbnm,."},
    Layout{U"ضصثقفغعهخحجدشسيبلاتنمكطئءؤرىةوزظ", U"qwertyuiop[]asdfghjkl;'zxcvnm,./"},
};

}  // namespace

char32_t place_on_us_keyboard(char32_t typed) {
  for (const Layout& layout : kLayouts) {
    assert(layout.typed.size() == layout.places.size());
    const std::size_t at = layout.typed.find(typed);
    if (at != std::u32string_view::npos) return layout.places[at];
  }
  return 0;
}

}  // namespace woodlouse::client
