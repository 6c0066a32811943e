// The config file beside what is read of it by config.h: where it is, its keys, and what the program writes
// there.
#pragma once

#include <filesystem>
#include <string>

#include "client/controls/key_map.h"
#include "shared/core/error.h"
#include "shared/json/document.h"

namespace woodlouse::client {

/// $XDG_CONFIG_HOME/woodlouse/config.json, or in ~/.config; empty: the account has no home.
std::filesystem::path config_file();

/// {"up": ["z", "Up"], "cruise": "Enter"}: an action, and its key or keys. Error: where = the action.
core::Expected<KeyMap> keys_of(const json::Value& value);

/// `text` of a config file, empty for a new one, with the name set. REQUIRES an object that has none.
std::string with_name(std::string text, const std::string& name);

/// Keeps the name in that file, whole or not at all, where none stands there by now; makes it and its folder
/// where there are none. Error: why not.
core::Expected<void> remember_name(const std::filesystem::path& file, const std::string& name);

}  // namespace woodlouse::client
