// Characters that are drawn over the one before them. Two of them are writing; a dozen are a blot over the
// lines above and below.
#pragma once

namespace woodlouse::protocol {

/// General category Mn or Me of the Unicode character database, version 14.0.0.
bool is_combining_mark(char32_t code);

}  // namespace woodlouse::protocol
