#include "shared/protocol/field_reader.h"

#include "shared/protocol/codes.h"
#include "shared/protocol/text_cleaning.h"

namespace woodlouse::protocol {
namespace {

std::string wants_integer(IntegerRange range) {
  return "an integer from " + std::to_string(range.low) + " to " + std::to_string(range.high);
}

}  // namespace

std::optional<json::Value> FieldReader::field(std::string_view name, std::string_view wants,
                                              Presence presence) {
  if (error_) return std::nullopt;
  const auto value = object_.find(name);
  if (!value && presence == Presence::kRequired) {
    fail(code::kMissingField, path_ + "." + std::string(name) + " is missing; it is " + std::string(wants));
  }
  return value;
}

std::optional<std::int64_t> FieldReader::checked_integer(std::string_view name, IntegerRange range,
                                                         Presence presence) {
  if (error_) return std::nullopt;
  const auto value = object_.find(name);
  const auto number = value ? json::integer_of(*value, range.low, range.high) : std::nullopt;
  if (number) return number;
  if (value) {
    refuse(name, *value, wants_integer(range));
  } else if (presence == Presence::kRequired) {
    field(name, wants_integer(range), presence);
  }
  return std::nullopt;
}

void FieldReader::number(std::string_view name, double& out, Presence presence) {
  const auto value = field(name, "a number", presence);
  if (!value) return;
  if (!value->is_number()) return refuse(name, *value, "a number");
  out = value->number();
}

void FieldReader::boolean(std::string_view name, bool& out, Presence presence) {
  const auto value = field(name, "true or false", presence);
  if (!value) return;
  if (value->kind() != json::Kind::kBoolean) return refuse(name, *value, "true or false");
  out = value->boolean();
}

void FieldReader::pair(std::string_view name, core::Vec2& out) {
  constexpr std::string_view kWants = "a pair of numbers [x, y]";
  const auto value = field(name, kWants, Presence::kRequired);
  if (!value) return;
  if (value->kind() != json::Kind::kArray || value->size() != 2) return refuse(name, *value, kWants);
  if (const auto numbers = json::pair_of(*value)) {
    out = *numbers;
    return;
  }
  array(name, kWants, [&](json::Value element, std::size_t index) {  // which of the two is none?
    if (!element.is_number()) refuse(name, index, element, "a number");
  });
}

void FieldReader::hash(std::string_view name, std::uint64_t& out) {
  constexpr std::string_view kWants = "16 hex digits in quotes";
  const auto value = field(name, kWants, Presence::kRequired);
  if (!value) return;
  const auto hash = json::hash_of(*value);
  if (!hash) return refuse(name, *value, kWants);
  out = *hash;
}

void FieldReader::cleaned_text(std::string_view name, std::string& out, ByteRange bytes, Presence presence) {
  const std::string wants = "a string of " + std::to_string(bytes.low) + " to " + std::to_string(bytes.high) +
                            " bytes, besides control and invisible characters";
  const auto value = field(name, wants, presence);
  if (!value) return;
  if (value->kind() != json::Kind::kString) return refuse(name, *value, wants);
  out = clean_text(value->text(), bytes.high);
  if (out.size() < bytes.low) refuse(name, *value, wants);
}

void FieldReader::key_text(std::string_view name, std::string& out, std::size_t most, Presence presence) {
  const std::string wants = "a string of at most " + std::to_string(most) + " bytes";
  const auto value = field(name, wants, presence);
  if (!value) return;
  if (value->kind() != json::Kind::kString || value->text().size() > most) return refuse(name, *value, wants);
  out = clean_text(value->text(), most);
}

void FieldReader::refuse(std::string_view name, json::Value found, std::string_view wants) {
  fail(code::kBadField,
       path_ + "." + std::string(name) + " is " + description(found) + "; it must be " + std::string(wants));
}

void FieldReader::refuse(std::string_view name, std::size_t index, json::Value found,
                         std::string_view wants) {
  fail(code::kBadField,
       element_path(name, index) + " is " + description(found) + "; it must be " + std::string(wants));
}

void FieldReader::fail(std::string_view error_code, std::string text) {
  if (!error_) error_ = DecodeError{std::string(error_code), std::move(text), true};
}

std::string FieldReader::element_path(std::string_view name, std::size_t index) const {
  return path_ + "." + std::string(name) + "[" + std::to_string(index) + "]";
}

}  // namespace woodlouse::protocol
