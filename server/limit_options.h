// The options of a server's limits: one for each that hello declares and an operator may set.
#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <string>

#include "server/option_checks.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

/// messages_per_s -> messages-per-s
inline std::string limit_option(const protocol::LimitField& field) {
  std::string name(field.name);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

inline void add_limit_options(CLI::App& app, protocol::Limits& limits) {
  for (const protocol::LimitField& field : protocol::limit_fields()) {
    if (!field.is_option) continue;
    std::string variable = "WOODLOUSE_" + std::string(field.name);
    std::transform(variable.begin(), variable.end(), variable.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    std::string text =
        (field.unit.empty() ? "" : "[" + std::string(field.unit) + "] ") + std::string(field.meaning);
    if (limits.*field.member == 0) text += "; left out: by the tick rate";
    app.add_option("--" + limit_option(field), limits.*field.member, text)
        ->envname(variable)
        ->check(whole_number(field.least, field.most))
        ->group("Limits, which hello declares")
        ->default_str(limits.*field.member == 0 ? "" : std::to_string(limits.*field.member));
  }
}

}  // namespace woodlouse::server
