// Builds one line: {"type":"...",members...}\n, members in the order they are added.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/vec2.h"
#include "shared/json/text.h"

namespace woodlouse::json {

class ObjectText {
 public:
  explicit ObjectText(std::string_view type) : out_("{\"type\":") { append_string(out_, type); }

  ObjectText& text(std::string_view name, std::string_view value) {
    append_string(key(name), value);
    return *this;
  }
  template <std::integral T>
  ObjectText& integer(std::string_view name, T value) {
    append_integer(key(name), value);
    return *this;
  }
  ObjectText& number(std::string_view name, double value) {
    append_double(key(name), value);
    return *this;
  }
  ObjectText& boolean(std::string_view name, bool value) {
    key(name) += value ? "true" : "false";
    return *this;
  }
  ObjectText& pair(std::string_view name, core::Vec2 value) {
    append_double(key(name) += '[', value.x);
    append_double(out_ += ',', value.y);
    out_ += ']';
    return *this;
  }
  /// A member that is JSON already.
  ObjectText& json(std::string_view name, std::string_view value) {
    key(name) += value;
    return *this;
  }
  /// An array: write(out, element) appends each element.
  template <typename Elements, typename Write>
  ObjectText& array(std::string_view name, const Elements& elements, Write write) {
    key(name) += '[';
    bool first = true;
    for (const auto& element : elements) {
      if (!std::exchange(first, false)) out_ += ',';
      write(out_, element);
    }
    out_ += ']';
    return *this;
  }
  /// An object: write(*this) appends its members.
  template <typename Write>
  ObjectText& object(std::string_view name, Write write) {
    key(name) += '{';
    begins_ = true;
    write(*this);
    begins_ = false;
    out_ += '}';
    return *this;
  }

  [[nodiscard]] std::string line() && { return std::move(out_ += "}\n"); }

 private:
  std::string& key(std::string_view name) {
    if (!std::exchange(begins_, false)) out_ += ',';
    append_string(out_, name);
    return out_ += ':';
  }

  std::string out_;
  bool begins_ = false;  ///< an object was just opened: its first member needs no comma
};

}  // namespace woodlouse::json
