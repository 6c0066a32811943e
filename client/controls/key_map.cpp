#include "client/controls/key_map.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "client/terminal/key_places.h"
#include "shared/core/utf8.h"

namespace woodlouse::client {
namespace {

constexpr std::array<std::string_view, kControlCount> kControlNames = {
    "up",   "down", "left",   "right",  "brake",   "cruise",   "respawn", "ghost", "gate",  "chat", "scores",
    "view", "help", "labels", "trails", "zoom_in", "zoom_out", "next",    "steer", "error", "quit"};

struct NamedKey {
  std::string_view name;   ///< in the config file
  std::string_view label;  ///< on the screen
  BoundKey key;
};
constexpr std::array kNamedKeys = {
    NamedKey{"Space", "SPC", {KeyCode::kCharacter, U' '}},
    NamedKey{"Up", "Up", {KeyCode::kUp}},
    NamedKey{"Down", "Down", {KeyCode::kDown}},
    NamedKey{"Left", "Left", {KeyCode::kLeft}},
    NamedKey{"Right", "Right", {KeyCode::kRight}},
    NamedKey{"Tab", "TAB", {KeyCode::kTab}},
    NamedKey{"Enter", "Enter", {KeyCode::kEnter}},
    NamedKey{"Backspace", "BSP", {KeyCode::kBackspace}},
    NamedKey{"Delete", "DEL", {KeyCode::kDelete}},
    NamedKey{"Home", "Home", {KeyCode::kHome}},
    NamedKey{"End", "End", {KeyCode::kEnd}},
    NamedKey{"PageUp", "PgUp", {KeyCode::kPageUp}},
    NamedKey{"PageDown", "PgDn", {KeyCode::kPageDown}},
};

template <typename Names, typename NameOf>
std::string listed(const Names& names, NameOf name_of) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : " ") + std::string(name_of(name));
  return text;
}

std::optional<BoundKey> key_of(const std::string& name) {
  for (const NamedKey& named : kNamedKeys)
    if (named.name == name) return named.key;
  // One character, as the keyboard's own decoder reads it.
  Keyboard decoder;
  std::vector<TerminalInput> inputs;
  decoder.feed(name, core::Time{}, inputs);
  const Key* const key = inputs.size() == 1 ? std::get_if<Key>(&inputs.front()) : nullptr;
  if (key == nullptr || key->code != KeyCode::kCharacter || key->control) return std::nullopt;
  const char32_t c = key->character;
  return BoundKey{KeyCode::kCharacter, c >= U'A' && c <= U'Z' ? c + (U'a' - U'A') : c};
}

constexpr std::size_t index_of(Control control) { return static_cast<std::size_t>(control); }

}  // namespace

char32_t letter_of(const Key& key) {
  char32_t c = key.character;
  if (c > 0x7e && key.physical != 0) c = key.physical;
  if (const char32_t place = place_on_us_keyboard(c)) c = place;
  return c >= U'A' && c <= U'Z' ? c + (U'a' - U'A') : c;
}

KeyMap::KeyMap() {
  const auto give = [this](Control control, std::u32string_view characters,
                           std::initializer_list<KeyCode> codes) {
    auto& keys = keys_[index_of(control)];
    for (std::size_t i = 0; i < characters.size(); ++i) {
      keys.push_back({KeyCode::kCharacter, characters[i]});
      if (i > 0) continue;  // the arrow is the second to be named
      for (const KeyCode code : codes) keys.push_back({code, 0});
    }
    if (characters.empty())
      for (const KeyCode code : codes) keys.push_back({code, 0});
  };
  // The digits are the number pad's.
  give(Control::kUp, U"w8", {KeyCode::kUp});
  give(Control::kDown, U"s2", {KeyCode::kDown});
  give(Control::kLeft, U"a4", {KeyCode::kLeft});
  give(Control::kRight, U"d6", {KeyCode::kRight});
  give(Control::kBrake, U"x5", {});
  give(Control::kCruise, U" ", {});
  give(Control::kRespawn, U"r", {});
  give(Control::kGhost, U"g", {});
  give(Control::kGate, U"b", {});
  give(Control::kChat, U"t", {});
  give(Control::kScores, U"", {KeyCode::kTab});
  give(Control::kView, U"v", {});
  give(Control::kHelp, U"?h", {});
  give(Control::kLabels, U"l", {});
  give(Control::kTrails, U"p", {});
  give(Control::kZoomIn, U"+=", {});
  give(Control::kZoomOut, U"-_", {});
  give(Control::kNext, U"n", {});
  give(Control::kSteer, U"c", {});
  give(Control::kError, U"e", {});
  give(Control::kQuit, U"q", {});
}

std::optional<Control> KeyMap::owner(const BoundKey& key) const {
  for (std::size_t i = 0; i < kControlCount; ++i)
    if (std::find(keys_[i].begin(), keys_[i].end(), key) != keys_[i].end()) return static_cast<Control>(i);
  return std::nullopt;
}

std::optional<Control> KeyMap::find(const Key& key) const {
  if (key.code != KeyCode::kCharacter) return owner({key.code, 0});
  if (key.character > 0x7e)
    if (const auto exact = owner({KeyCode::kCharacter, key.character})) return exact;
  return owner({KeyCode::kCharacter, letter_of(key)});
}

core::Expected<void> KeyMap::bind(std::string_view action, const std::vector<std::string>& keys) {
  const auto name = std::find(kControlNames.begin(), kControlNames.end(), action);
  if (name == kControlNames.end())
    return core::fail(std::string(action), "no such action",
                      "known: " + listed(kControlNames, [](std::string_view n) { return n; }));
  if (keys.empty()) return core::fail(std::string(action), "it has no key");
  std::vector<BoundKey> bound;
  for (const std::string& text : keys) {
    const auto key = key_of(text);
    if (!key)
      return core::fail(std::string(action), "\"" + text + "\" is no key",
                        "one character, or " + listed(kNamedKeys, [](const NamedKey& n) { return n.name; }));
    if (std::find(bound_.begin(), bound_.end(), *key) != bound_.end())
      return core::fail(std::string(action), "\"" + text + "\" is bound twice");
    for (auto& others : keys_) std::erase(others, *key);
    bound.push_back(*key);
    bound_.push_back(*key);
  }
  keys_[static_cast<std::size_t>(name - kControlNames.begin())] = std::move(bound);
  return {};
}

core::Expected<void> KeyMap::is_complete() const {
  for (std::size_t i = 0; i < kControlCount; ++i)
    if (keys_[i].empty())
      return core::fail(std::string(kControlNames[i]), "no key is left for it",
                        "name one here, for example \"" + std::string(kControlNames[i]) + "\": [\"k\"]");
  return {};
}

std::string KeyMap::label(Control control, std::size_t index) const {
  const auto& keys = keys_[index_of(control)];
  if (index >= keys.size()) return {};
  for (const NamedKey& named : kNamedKeys)
    if (named.key == keys[index]) return std::string(named.label);
  const char32_t c = keys[index].character;
  assert(c != 0);
  std::string text;
  core::append_character(text, c >= U'a' && c <= U'z' ? c - (U'a' - U'A') : c);
  return text;
}

KeyLabels KeyMap::labels() const {
  KeyLabels labels;
  labels.up = label(Control::kUp, 0), labels.up2 = label(Control::kUp, 1);
  labels.down = label(Control::kDown, 0), labels.down2 = label(Control::kDown, 1);
  labels.left = label(Control::kLeft, 0), labels.right = label(Control::kRight, 0);
  labels.brake = label(Control::kBrake, 0), labels.cruise = label(Control::kCruise, 0);
  labels.respawn = label(Control::kRespawn, 0), labels.chat = label(Control::kChat, 0);
  labels.ghost = label(Control::kGhost, 0), labels.gate = label(Control::kGate, 0);
  labels.scores = label(Control::kScores, 0), labels.view = label(Control::kView, 0);
  labels.help = label(Control::kHelp, 0), labels.labels = label(Control::kLabels, 0);
  labels.trails = label(Control::kTrails, 0), labels.zoom_in = label(Control::kZoomIn, 0);
  labels.zoom_out = label(Control::kZoomOut, 0), labels.next = label(Control::kNext, 0);
  labels.steer = label(Control::kSteer, 0), labels.error = label(Control::kError, 0);
  labels.quit = label(Control::kQuit, 0);
  return labels;
}

}  // namespace woodlouse::client
