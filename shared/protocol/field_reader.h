// Takes the fields of one message out of its JSON object and checks each against its kind and range. The
// first fault is kept and says which field, what was found and what is allowed; after it, reads do nothing.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "shared/json/fields.h"
#include "shared/protocol/line_object.h"

namespace woodlouse::protocol {

enum class Presence : std::uint8_t { kRequired, kOptional };

struct IntegerRange {
  std::int64_t low = 0, high = kMaxInteger;
};
struct ByteRange {
  std::size_t low = 0, high = 0;
};

inline constexpr IntegerRange kAnyTick{};
inline constexpr IntegerRange kAnyUint32{0, 0xffff'ffff};
inline constexpr IntegerRange kAnyInteger{-kMaxInteger, kMaxInteger};

class FieldReader {
 public:
  /// `path` begins the fields' names in errors: "join" gives "join.name".
  FieldReader(json::Value object, std::string path) : object_(object), path_(std::move(path)) {}

  /// The field itself, whatever its kind. `wants` describes it, for the error when it is required and
  /// missing.
  std::optional<json::Value> field(std::string_view name, std::string_view wants, Presence presence);

  template <std::integral T>
  void integer(std::string_view name, T& out, IntegerRange range, Presence presence = Presence::kRequired) {
    if (const auto value = checked_integer(name, range, presence)) out = static_cast<T>(*value);
  }
  template <std::integral T>
  void integer(std::string_view name, std::optional<T>& out, IntegerRange range) {
    if (const auto value = checked_integer(name, range, Presence::kOptional)) out = static_cast<T>(*value);
  }
  void number(std::string_view name, double& out, Presence presence = Presence::kRequired);
  void boolean(std::string_view name, bool& out, Presence presence = Presence::kRequired);
  /// Two numbers.
  void pair(std::string_view name, core::Vec2& out);
  /// 16 lower-case hex digits.
  void hash(std::string_view name, std::uint64_t& out);
  /// Cleaned (text_cleaning.h), then of `bytes.low` bytes at least, cut to `bytes.high`.
  void cleaned_text(std::string_view name, std::string& out, ByteRange bytes,
                    Presence presence = Presence::kRequired);
  /// Cleaned as well, but what is longer than `most` bytes is refused: a name that was cut may be another
  /// one's.
  void key_text(std::string_view name, std::string& out, std::size_t most,
                Presence presence = Presence::kRequired);
  /// One of the texts that `from_text` knows; `wants` lists them.
  template <typename E, typename FromText>
  void choice(std::string_view name, E& out, std::string_view wants, FromText from_text,
              Presence presence = Presence::kRequired) {
    const auto value = field(name, wants, presence);
    if (!value) return;
    const std::optional<E> found = json::choice_of(*value, from_text);
    if (found) {
      out = *found;
    } else {
      refuse(name, *value, wants);
    }
  }
  /// Calls read(FieldReader&) on an object, keeping its error.
  template <typename Read>
  void object(std::string_view name, Read read, Presence presence = Presence::kRequired) {
    const auto value = field(name, "an object", presence);
    if (!value) return;
    if (value->kind() != json::Kind::kObject) return refuse(name, *value, "an object");
    FieldReader inner(*value, path_ + "." + std::string(name));
    read(inner);
    if (inner.error_) error_ = std::move(inner.error_);
  }
  /// Calls read(value, index) for each element of an array until it fails.
  template <typename Read>
  void array(std::string_view name, std::string_view wants, Read read,
             Presence presence = Presence::kRequired) {
    const auto value = field(name, wants, presence);
    if (!value) return;
    if (value->kind() != json::Kind::kArray) return refuse(name, *value, wants);
    std::size_t index = 0;
    value->for_each([&](json::Value element) {
      read(element, index++);
      return !error_.has_value();
    });
  }
  /// An array of objects: read(FieldReader&) on each.
  template <typename Read>
  void objects(std::string_view name, Read read) {
    array(name, "an array of objects", [&](json::Value element, std::size_t index) {
      if (element.kind() != json::Kind::kObject) return refuse(name, index, element, "an object");
      FieldReader inner(element, element_path(name, index));
      read(inner);
      if (inner.error_) error_ = std::move(inner.error_);
    });
  }

  void refuse(std::string_view name, json::Value found, std::string_view wants);
  void refuse(std::string_view name, std::size_t index, json::Value found, std::string_view wants);
  void fail(std::string_view error_code, std::string text);
  [[nodiscard]] bool failed() const { return error_.has_value(); }

  /// The message, or the first fault.
  template <typename Variant, typename Message>
  tl::expected<Variant, DecodeError> finish(Message&& message) {
    if (error_) return tl::unexpected(std::move(*error_));
    return Variant(std::forward<Message>(message));
  }

 private:
  std::optional<std::int64_t> checked_integer(std::string_view name, IntegerRange range, Presence presence);
  [[nodiscard]] std::string element_path(std::string_view name, std::size_t index) const;

  json::Value object_;
  std::string path_;
  std::optional<DecodeError> error_;
};

}  // namespace woodlouse::protocol
