// Things chosen by name: an unknown one is answered with the list of those there are.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "bench/lab/methods/laboratory.h"
#include "shared/core/error.h"
#include "shared/document/surface_catalogue.h"
#include "shared/terrain/function_surface.h"

namespace woodlouse::lab {

/// "a b c", of anything that to_text() takes.
template <typename All>
std::string names_of(const All& all) {
  std::string list;
  for (const auto one : all) {
    if (!list.empty()) list += ' ';
    list += to_text(one);
  }
  return list;
}

/// `found`, or an error that lists `names`.
template <typename E>
core::Expected<E> chosen(std::string_view option, std::string_view text, const std::optional<E>& found,
                         const std::string& names) {
  if (found) return *found;
  return core::fail(std::string(option), "there is no \"" + std::string(text) + "\"", "one of: " + names);
}

inline core::Expected<terrain::FunctionName> function_named(std::string_view text) {
  return chosen("--function", text, terrain::function_from_text(text), names_of(terrain::kFunctionNames));
}
inline core::Expected<Equations> equations_named(std::string_view text) {
  return chosen("--equations", text, equations_from_text(text), names_of(kEquations));
}
inline core::Expected<Integrator> integrator_named(std::string_view text) {
  return chosen("--integrator", text, integrator_from_text(text), names_of(kIntegrators));
}

inline constexpr std::array kContacts = {state::SurfaceContact::kBilateral,
                                         state::SurfaceContact::kUnilateral};
inline core::Expected<state::SurfaceContact> contact_named(std::string_view text) {
  return chosen("--contact", text, state::contact_from_text(text), names_of(kContacts));
}

}  // namespace woodlouse::lab
