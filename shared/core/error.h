// What went wrong, where, and what to do: the one error type of everything that reads bytes from outside.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "shared/core/printable.h"

namespace woodlouse::core {

/// An error a person can act on. `where` names the place (file, line, JSON field), `what` the fault,
/// `hint` what to try; `where` and `hint` may be empty. Each is made printable here, so that whoever shows
/// one needs not know what of it came from outside.
struct Error {
  std::string where;
  std::string what;
  std::string hint;

  Error() = default;
  Error(const std::string& place, const std::string& fault, const std::string& advice = {})
      : where(printable(place)), what(printable(fault)), hint(printable(advice)) {}

  /// `where: what`, with ` (hint)` when there is one.
  [[nodiscard]] std::string text() const {
    std::string result = where.empty() ? what : where + ": " + what;
    if (!hint.empty()) result += " (" + hint + ")";
    return result;
  }
};

/// A value, or the reason why there is none.
template <typename T>
using Expected = tl::expected<T, Error>;

/// The failing side of an Expected.
inline tl::unexpected<Error> fail(const std::string& where, const std::string& what,
                                  const std::string& hint = {}) {
  return tl::unexpected<Error>(Error(where, what, hint));
}

}  // namespace woodlouse::core
