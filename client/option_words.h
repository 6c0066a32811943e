// The words that options take, on the command line as in the config file.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/config.h"

namespace woodlouse::client {

/// The words an option takes, with their values. Used by the command line and the config file alike.
template <typename T>
struct Words {
  std::vector<std::pair<std::string, T>> entries;

  std::optional<T> find(const std::string& word) const {
    for (const auto& [name, value] : entries) {
      if (name == word) return value;
    }
    return std::nullopt;
  }
  std::string word(T value) const {
    for (const auto& [name, known] : entries) {
      if (known == value) return name;
    }
    return {};
  }
  std::string list() const {
    std::string text;
    for (const auto& [name, value] : entries) text += (text.empty() ? "" : "|") + name;
    return text;
  }
};

inline const Words<ColorChoice>& color_words() {
  static const Words<ColorChoice> words{{{"auto", ColorChoice::kAuto},
                                         {"truecolor", ColorChoice::kTruecolor},
                                         {"256", ColorChoice::k256},
                                         {"16", ColorChoice::k16},
                                         {"mono", ColorChoice::kMono}}};
  return words;
}
inline const Words<GlyphChoice>& glyph_words() {
  static const Words<GlyphChoice> words{{{"auto", GlyphChoice::kAuto},
                                         {"half", GlyphChoice::kHalfBlocks},
                                         {"ascii", GlyphChoice::kAscii},
                                         {"text", GlyphChoice::kText}}};
  return words;
}
inline const Words<Palette>& palette_words() {
  static const Words<Palette> words{
      {{"default", Palette::kDefault}, {"deutan", Palette::kDeutan}, {"tritan", Palette::kTritan}}};
  return words;
}
inline const Words<std::optional<View>>& view_words() {
  static const Words<std::optional<View>> words{{{"auto", std::nullopt},
                                                 {"map", View::kMap},
                                                 {"oblique", View::kOblique},
                                                 {"follow", View::kFollow},
                                                 {"slope", View::kSlope}}};
  return words;
}

inline const Words<SteerBy>& steer_words() {
  static const Words<SteerBy> words{{{"heading", SteerBy::kHeading}, {"compass", SteerBy::kCompass}}};
  return words;
}

}  // namespace woodlouse::client
