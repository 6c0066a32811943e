// What a finished CSI sequence says: parameters "1:2;3" and a final byte to a key, an answer or nothing. Also
// SS3 and DCS. Legacy cursor keys, xterm's modifiers, the kitty keyboard protocol. Pure.
#pragma once

#include <string_view>
#include <vector>

#include "client/terminal/keyboard.h"

namespace woodlouse::client {

/// Appends what CSI `parameters` `final` means; nothing for sequences nobody needs.
void decode_csi(std::string_view parameters, char final, std::vector<TerminalInput>& out);

/// Appends what the string DCS `text` ST says: the answer to DCS $ q; nothing for others.
void decode_dcs(std::string_view text, std::vector<TerminalInput>& out);

/// What a key of the number pad types, by the final byte of its SS3 in application mode; 0: none.
char32_t keypad_character(char final);

/// The cursor key of the final byte of CSI or SS3 (A, B, C, D, H, F), if it is one.
std::optional<KeyCode> cursor_key(char final);

}  // namespace woodlouse::client
