// What an exported function has to say besides a number: text, which stays until the next call that answers
// with some.
#pragma once

#include <string>

#include "shared/core/error.h"

/// A function that the page calls by its own name.
#define WOODLOUSE_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace woodlouse::web {

/// The text of the last answer, emptied: to write the next one.
std::string& answer();

/// Answers with an error's words; 0, as whoever has no handle to give says.
int refuse(const core::Error& error);

}  // namespace woodlouse::web
