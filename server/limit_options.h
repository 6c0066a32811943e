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

/// Of what was typed: those that follow from others and from the tick rate.
inline protocol::Limits completed(protocol::Limits typed, std::uint32_t tick_hz) {
  // A bot may push once a tick and still ask for the time.
  if (typed.messages_per_s == 0) typed.messages_per_s = std::max(60u, 2 * tick_hz);
  if (typed.burst == 0) typed.burst = 2 * typed.messages_per_s;
  typed.per_room = typed.max_players + typed.max_bots + typed.max_spectators;
  return typed;
}

struct ServeConfig;

/// As many connections as there may be files open, some of which the server needs itself.
protocol::Limits limits_of(const ServeConfig& config);

}  // namespace woodlouse::server
