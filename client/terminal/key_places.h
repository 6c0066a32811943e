// Keys by their place: what a letter of another alphabet's layout would type on a US keyboard.
#pragma once

namespace woodlouse::client {

/// Of the Russian, Ukrainian, Greek, Hebrew and Arabic layouts, either case; 0: none of theirs. Pure.
char32_t place_on_us_keyboard(char32_t typed);

}  // namespace woodlouse::client
