// What the player asked for: command line over WOODLOUSE_* over config.json over default, checked once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/controls/driving.h"
#include "client/controls/key_map.h"
#include "client/drawing/scene.h"
#include "client/net/address.h"
#include "client/play/keyframe_verifier.h"
#include "client/play/look_choice.h"
#include "shared/core/error.h"

namespace woodlouse::client {

enum class Part : std::uint8_t {
  kPlay,
  kWatch,
  kReplay,  ///< a recording; no server
  kRooms,   ///< a list of a server's rooms; REQUIRES a server
};

struct Config {
  std::optional<Address> server;  ///< none: start one here
  std::string map = "volcano";    ///< of the server started here: a file, or a name
  std::string name;               ///< at most 24 bytes
  std::string room;               ///< empty: the server's first
  std::string token;              ///< a password of the server; empty: none
  std::string recording;          ///< of Part::kReplay: its file
  std::string maps;               ///< of Part::kReplay: where its map may be, besides beside it
  Part part = Part::kPlay;
  Hashes hashes = Hashes::kIgnored;
  ColorChoice color = ColorChoice::kAuto;
  GlyphChoice glyphs = GlyphChoice::kAuto;
  Palette palette = Palette::kDefault;
  std::optional<View> view;  ///< none: what suits the terminal
  int fps = 30;              ///< 5..60
  bool asks_name = false;    ///< nobody has said it yet: name is a suggestion
  bool bell = false;         ///< rung when something happens to your louse
  SteerBy steer = SteerBy::kCompass;
  KeyMap keys;
  /// For who plays from another's account (ssh): nothing of it is read or written, no config file, map or
  /// recording, and no server is started. REQUIRES a server, and no replay.
  bool no_files = false;
};

/// A configuration, or why the program ends now: help and version end it with 0, mistakes with 2.
struct Parsed {
  Config config;
  std::optional<int> exit_code;
  std::string output;  ///< what to print then
};

/// Reads the command line, the environment and the config file.
Parsed parse_arguments(int argc, const char* const* argv);

/// What a config.json says, over `config`. Error: where =
/// "file:line: field".
core::Expected<Config> read_config_file(const std::string& text, const std::string& file, Config config);

}  // namespace woodlouse::client
