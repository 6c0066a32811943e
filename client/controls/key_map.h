// Which keys do what: as they are, or as the config file has them. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/drawing/key_labels.h"
#include "client/terminal/keyboard.h"
#include "shared/core/error.h"

namespace woodlouse::client {

/// What keys are bound to. up and down push and brake, or push up and down (Steering).
enum class Control : std::uint8_t {
  kUp,
  kDown,
  kLeft,
  kRight,
  kBrake,
  kCruise,
  kRespawn,
  kGhost,
  kGate,
  kChat,
  kScores,
  kView,
  kHelp,
  kLabels,
  kTrails,
  kZoomIn,
  kZoomOut,
  kNext,
  kSteer,
  kError,
  kQuit,
};
inline constexpr std::size_t kControlCount = 21;

/// A key by what it types, small letters, or by its name.
struct BoundKey {
  KeyCode code = KeyCode::kCharacter;
  char32_t character = 0;
  friend bool operator==(const BoundKey&, const BoundKey&) = default;
};

class KeyMap {
 public:
  KeyMap();

  /// What the key is bound to: by what it types, else by its place on a US keyboard.
  [[nodiscard]] std::optional<Control> find(const Key& key) const;
  /// Gives `action` these keys, which nothing else has any more. Error: no such action or key, or one that
  /// was bound before; what is possible stands in the hint.
  core::Expected<void> bind(std::string_view action, const std::vector<std::string>& keys);
  /// After all bind(): whether each action has a key left. Error: the first that has none.
  [[nodiscard]] core::Expected<void> is_complete() const;
  /// What the help and the bottom line call them.
  [[nodiscard]] KeyLabels labels() const;

  friend bool operator==(const KeyMap&, const KeyMap&) = default;

 private:
  [[nodiscard]] std::optional<Control> owner(const BoundKey& key) const;
  [[nodiscard]] std::string label(Control control, std::size_t index) const;

  std::array<std::vector<BoundKey>, kControlCount> keys_;
  std::vector<BoundKey> bound_;  ///< by bind(): nobody else may have them
};

/// The letter a key goes by: small; on other alphabets' layouts the key in that place.
char32_t letter_of(const Key& key);

}  // namespace woodlouse::client
