// How many columns of a terminal a character takes, and which characters are shown at all.
//
// By Unicode 15.0: two columns for East Asian Wide and Fullwidth (ideographs, kana, hangul, emoji), none for
// what stands on the character before it (combining marks, joiners, variation selectors, skin tones);
// ambiguous ones are narrow. The tables are those of python3-wcwidth 0.2.5, by which pyte, the emulator of
// the tests, goes. A terminal of another opinion is put right at the next character: after a wide one the
// encoder names the place.
#pragma once

#include <string>

namespace woodlouse::client {

/// Stands in the second column of a wide character, in texts and in cells: so a text is as long as it is
/// wide.
inline constexpr char32_t kWideTail = U'\0';

/// 1 or 2; 0 for what belongs to the character before it; -1 for what is not shown: control characters, those
/// that turn the direction of writing, and letters of writings that terminals do not agree on.
int columns_of(char32_t character);

/// The one character for a letter and a mark on it (e and U+0301: U+00E9), of Latin, Greek, Cyrillic, kana
/// and hangul; 0: there is none.
char32_t composed(char32_t letter, char32_t mark);

/// What stands for a character where only ASCII is shown: itself, a Latin letter without its marks, or '?'.
char ascii_of(char32_t character);

}  // namespace woodlouse::client
