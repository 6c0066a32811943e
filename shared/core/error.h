// What went wrong, where, and what to do: the one error type of everything that reads bytes from outside.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace woodlouse::core {

/// An error a person can act on. `where` names the place (file, line, JSON field), `what` the fault,
/// `hint` what to try; `hint` may be empty.
struct Error {
  std::string where;
  std::string what;
  std::string hint;

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
inline tl::unexpected<Error> fail(std::string where, std::string what, std::string hint = {}) {
  return tl::unexpected<Error>(Error{std::move(where), std::move(what), std::move(hint)});
}

}  // namespace woodlouse::core
