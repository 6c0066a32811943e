// Writes one JSON object, members in the order they are added: the wire's lines, recordings, canonical maps.
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/vec2.h"
#include "shared/json/text.h"

namespace woodlouse::json {

/// Elements of an array, each written by write(out, element), with commas between and brackets around.
template <typename Elements, typename Write>
void append_array(std::string& out, const Elements& elements, const Write& write) {
  out += '[';
  bool first = true;
  for (const auto& element : elements) {
    if (!std::exchange(first, false)) out += ',';
    write(out, element);
  }
  out += ']';
}

/// The object is open until end() or end_line(). REQUIRES names of at most kMaxNameBytes that stand in JSON
/// as they are.
class ObjectText {
 public:
  /// Appends to `out`, which must outlive it.
  explicit ObjectText(std::string& out) : out_(out) { out_ += '{'; }
  /// A message of the wire, whose first member is its type.
  ObjectText(std::string& out, std::string_view type) : ObjectText(out) { text("type", type); }
  ObjectText(const ObjectText&) = delete;
  ObjectText& operator=(const ObjectText&) = delete;

  ObjectText& text(std::string_view name, std::string_view value) {
    append_string(key(name), value);
    return *this;
  }
  template <std::integral T>
  ObjectText& integer(std::string_view name, T value) {
    return short_member(name, [&](char* to) { return write_integer(to, value); });
  }
  ObjectText& number(std::string_view name, double value) {
    return short_member(name, [&](char* to) { return write_double(to, value); });
  }
  ObjectText& boolean(std::string_view name, bool value) {
    const std::string_view text = value ? "true" : "false";
    return short_member(name, [&](char* to) { return std::copy(text.begin(), text.end(), to); });
  }
  /// 64 bits as 16 hex digits in quotes: many readers hold numbers as doubles.
  ObjectText& hash(std::string_view name, std::uint64_t value) {
    append_hash(key(name), value);
    return *this;
  }
  ObjectText& pair(std::string_view name, core::Vec2 value) {
    append_pair(key(name), value.x, value.y);
    return *this;
  }
  /// A member that is JSON already.
  ObjectText& json(std::string_view name, std::string_view value) {
    assert(!value.empty());
    key(name) += value;
    return *this;
  }
  /// A member whose value write(out) appends.
  template <typename Write>
  ObjectText& value(std::string_view name, const Write& write) {
    write(key(name));
    return *this;
  }
  /// An array: write(out, element) appends each element.
  template <typename Elements, typename Write>
  ObjectText& array(std::string_view name, const Elements& elements, const Write& write) {
    append_array(key(name), elements, write);
    return *this;
  }
  /// An array of objects: write(ObjectText&, element) adds the members of each.
  template <typename Elements, typename Write>
  ObjectText& objects(std::string_view name, const Elements& elements, const Write& write) {
    return array(name, elements, [&](std::string& out, const auto& element) {
      ObjectText object(out);
      write(object, element);
      object.end();
    });
  }
  /// An object: write(ObjectText&) adds its members.
  template <typename Write>
  ObjectText& object(std::string_view name, const Write& write) {
    ObjectText inner(key(name));
    write(inner);
    inner.end();
    return *this;
  }

  /// Closes the object, which is complete now. Once.
  void end() { out_ += '}'; }
  /// Closes it, and its line.
  void end_line() { out_ += "}\n"; }

 private:
  /// Comma, name and colon, then what write(to) writes, for which there is kNumberRoom: appended at once.
  template <typename Write>
  ObjectText& short_member(std::string_view name, const Write& write) {
    char text[kMaxNameBytes + 4 + kNumberRoom];
    out_.append(text, write(write_key(text, name)));
    return *this;
  }
  std::string& key(std::string_view name) {
    char text[kMaxNameBytes + 4];
    return out_.append(text, write_key(text, name));
  }
  char* write_key(char* to, std::string_view name) {
    assert(name.size() <= kMaxNameBytes && std::all_of(name.begin(), name.end(), stands_as_it_is));
    if (!std::exchange(begins_, false)) *to++ = ',';
    *to++ = '"';
    to = std::copy(name.begin(), name.end(), to);
    *to++ = '"';
    *to++ = ':';
    return to;
  }

  static constexpr std::size_t kMaxNameBytes = 32;

  std::string& out_;
  bool begins_ = true;  ///< no member yet: the first needs no comma
};

}  // namespace woodlouse::json
