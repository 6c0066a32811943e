// Bytes from a terminal to keys: a state machine that takes them one at a time, so that a read() may hold
// half a key or five. No file descriptor, no clock: time is an argument.
//
// Understood: UTF-8; C0 controls; ESC [ and ESC O cursor keys; the kitty keyboard protocol (CSI code:shifted:
// base ; modifiers:event ; text u, and the same modifiers on CSI 1;m:e A); bracketed paste; focus reports;
// the answers to what terminal_answers.h asks. Every other sequence is swallowed whole, strings (DCS, OSC,
// APC) too. A lone ESC can't be told from the beginning of a sequence but by waiting: expire() does that.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/core/clock.h"

namespace woodlouse::client {

enum class KeyCode : std::uint8_t {
  kCharacter,
  kEnter,
  kTab,
  kBackspace,
  kEscape,
  kDelete,
  kUp,
  kDown,
  kLeft,
  kRight,
  kHome,
  kEnd,
  kPageUp,
  kPageDown,
};

enum class KeyAction : std::uint8_t { kPress, kRepeat, kRelease };

struct Key {
  KeyCode code = KeyCode::kCharacter;
  char32_t character = 0;  ///< kCharacter: what it types, shift applied; with control: the letter
  char32_t physical = 0;   ///< the key's character on a US keyboard, where the terminal says it
  bool control = false;
  bool alt = false;
  KeyAction action = KeyAction::kPress;
  friend bool operator==(const Key&, const Key&) = default;
};

/// Text between the brackets of a paste, cut at kMaxPasteBytes.
struct Paste {
  std::string text;
  friend bool operator==(const Paste&, const Paste&) = default;
};
/// The terminal speaks the kitty keyboard protocol; the flags now in force.
struct KittyFlags {
  unsigned flags = 0;
  friend bool operator==(const KittyFlags&, const KittyFlags&) = default;
};
/// The answer to CSI c, which every terminal gives: what was asked before and not answered by now never will
/// be.
struct DeviceAttributes {
  friend bool operator==(const DeviceAttributes&, const DeviceAttributes&) = default;
};
/// The answer to CSI 6 n: where the cursor stands, from 1.
struct CursorReport {
  unsigned row = 0;
  unsigned column = 0;
  friend bool operator==(const CursorReport&, const CursorReport&) = default;
};
/// The answer to CSI ? mode $ p. state: 0 unknown, 1 set, 2 reset, 3 and 4 the same for ever.
struct ModeReport {
  unsigned mode = 0;
  unsigned state = 0;
  friend bool operator==(const ModeReport&, const ModeReport&) = default;
};
/// The answer to DCS $ q: a setting as the sequence that makes it, or that it is not known.
struct SettingReport {
  bool is_known = false;
  std::string setting;
  friend bool operator==(const SettingReport&, const SettingReport&) = default;
};
enum class Focus : std::uint8_t { kGained, kLost };

using TerminalInput =
    std::variant<Key, Paste, KittyFlags, DeviceAttributes, CursorReport, ModeReport, SettingReport, Focus>;

class Keyboard {
 public:
  static constexpr std::size_t kMaxSequenceBytes = 64;  ///< longer ones are swallowed
  static constexpr std::size_t kMaxStringBytes = 256;   ///< after so many what began as a string is none
  static constexpr std::size_t kMaxPasteBytes = 1024;
  static constexpr std::chrono::milliseconds kEscapeTimeout{30};  ///< a lone ESC is the key after this
  static constexpr std::chrono::milliseconds kSequenceTimeout{
      500};  ///< half a sequence is dropped after this

  /// Takes bytes as read at `now`; appends what they mean to `out`.
  void feed(std::string_view bytes, core::Time now, std::vector<TerminalInput>& out);
  /// Ends what has waited too long: a lone ESC becomes the key.
  void expire(core::Time now, std::vector<TerminalInput>& out);
  /// When expire() would do something, if nothing arrives.
  [[nodiscard]] std::optional<core::Time> deadline() const;

 private:
  enum class State : std::uint8_t {
    kGround,
    kEscape,
    kCsi,
    kLinuxFunctionKey,
    kSs3,
    kUtf8,
    kPaste,
    kString,
    kStringEscape
  };

  void take(unsigned char byte, std::vector<TerminalInput>& out);
  void take_ground(unsigned char byte, std::vector<TerminalInput>& out);
  void take_escaped(unsigned char byte, std::vector<TerminalInput>& out);
  void take_ss3(unsigned char byte, std::vector<TerminalInput>& out);
  void take_string(unsigned char byte, std::vector<TerminalInput>& out);
  void take_utf8(unsigned char byte, std::vector<TerminalInput>& out);
  void take_csi(unsigned char byte, std::vector<TerminalInput>& out);
  void take_paste(unsigned char byte, std::vector<TerminalInput>& out);

  State state_ = State::kGround;
  core::Time last_byte_{};
  std::string sequence_;  ///< parameters of the CSI, or the string, under way
  bool is_dcs_ = false;   ///< the string is one that may answer
  bool overlong_ = false;
  std::string paste_;
  char32_t code_point_ = 0;  ///< UTF-8 under way
  char32_t smallest_ = 0;    ///< below this it would be an overlong form
  int missing_ = 0;          ///< continuation bytes still to come
};

}  // namespace woodlouse::client
