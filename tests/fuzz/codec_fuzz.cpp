// The codec, both directions: a line is a message in range that reads back the same once written, or an error
// with a code of the table that can itself be sent.
//
// Input: a letter that says who reads it ('c' the server; 'q', 'e' and 'a' a client with quantized rows,
// exact rows and all columns, exact), and the line.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/core/stable_hash.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/input_line.h"
#include "tests/fuzz/property.h"

using namespace woodlouse::protocol;
using woodlouse::fuzz::demand;
using woodlouse::fuzz::demand_readable;

namespace {

void demand_one_line(const std::string& text) {
  demand(text.find('\n') == text.size() - 1, "a message is one line", text);
}

void check(const DecodeError& error) {
  const auto& table = codes();
  demand(std::any_of(table.begin(), table.end(),
                     [&](const CodeEntry& entry) { return entry.code == error.code; }),
         "an error's code is in the table", error.code);
  demand_readable(error.text);
  const ServerMessage told = ErrorMessage{error.code, error.text, false, std::nullopt};
  const auto back = decode_server(encode(told), default_columns(), Format::kQuantized);
  demand(back && *back == told, "an error can be sent", error.text);
}

void check_range(const Join& join) {
  demand(!join.name.empty() && join.name.size() <= kMaxNameBytes, "a name has 1 to 24 bytes", join.name);
  demand(woodlouse::fuzz::is_plain_line(join.name), "a name is plain text", join.name);
  demand(join.room.size() <= kMaxRoomBytes, "a room's name is bounded", join.room);
  demand(join.fields.at(0) == Column::kId, "the first column is the id");
  demand(join.fields.size() <= kColumnCount, "every column is asked for once");
}
void check_range(const Input& input) {
  demand(woodlouse::core::dot(input.thrust.value, input.thrust.value) <= 1.0, "a thrust is no longer than 1");
  const double steps = input.thrust.value.x / woodlouse::state::kThrustQuantum;
  demand(steps == std::floor(steps), "a thrust is a multiple of its quantum");
  demand(!input.ticks || (*input.ticks >= 1 && *input.ticks <= kMaxThrustTicks), "ticks are in range");
}
void check_range(const Chat& chat) {
  demand(!chat.text.empty() && chat.text.size() <= kMaxChatBytes, "chat has 1 to 400 bytes", chat.text);
  demand(woodlouse::fuzz::is_plain_line(chat.text), "chat is plain text", chat.text);
}
template <typename Other>
void check_range(const Other&) {}

/// The scanner takes nothing that the document's parser, which no line with a tab passes by, takes otherwise.
void check_scanned(std::string_view line) {
  const auto scanned = scan_input(line);
  if (!scanned) return;
  const auto message = decode_client("\t" + std::string(line));
  const auto* input = message ? std::get_if<Input>(&*message) : nullptr;
  demand(input != nullptr && *input == *scanned, "a scanned input is what the document says",
         std::string(line));
}

void check_client_line(std::string_view line) {
  check_scanned(line);
  const auto message = decode_client(line);
  if (!message) return check(message.error());
  std::visit([](const auto& alternative) { check_range(alternative); }, *message);
  const std::string text = encode(*message);
  demand_one_line(text);
  demand(text.size() <= kMaxLineBytes + 1, "what is written is within the server's limit", text);
  auto again = decode_client(text);
  demand(again.has_value(), "what is written can be read", text);
  if (auto* input = std::get_if<Input>(&*again)) input->clamped = std::get<Input>(*message).clamped;
  demand(*again == *message, "what is written reads back the same", text);
  demand(encode(*again) == text, "what is written is written the same again", text);
}

/// A frame as the server writes one; empty where a value is beyond what a server may write.
std::string frame_text(const Frame& frame, const std::vector<Column>& fields, Format format) {
  std::string out = frame.is_key ? "{\"type\":\"key\",\"tick\":" : "{\"type\":\"delta\",\"tick\":";
  out += std::to_string(frame.tick);
  if (!frame.is_key) out += ",\"base\":" + std::to_string(frame.base);
  out += ",\"louse\":[";
  for (std::size_t k = 0; k < frame.values.size(); ++k) {
    const std::size_t column = k % fields.size();
    const bool is_integer = quantum(fields[column]) == 1.0;
    const double value = frame.values[k];
    if (format == Format::kQuantized &&
        std::abs(value) / quantum(fields[column]) > static_cast<double>(kMaxInteger)) {
      return {};
    }
    out += k == 0 ? "[" : column == 0 ? "],[" : ",";
    char number[kValueRoom];
    const char* const end =
        write_value(number, value, fields[column], is_integer ? Format::kQuantized : format);
    out.append(number, static_cast<std::size_t>(end - number));
  }
  out += frame.values.empty() ? "]" : "]]";
  if (!frame.gone.empty()) {
    for (std::size_t k = 0; k < frame.gone.size(); ++k)
      out += (k == 0 ? ",\"gone\":[" : ",") + std::to_string(frame.gone[k]);
    out += ']';
  }
  const auto append_hash = [&out](std::string_view key, std::uint64_t hash) {
    out.append(",\"").append(key).append("\":\"").append(woodlouse::core::to_hex(hash)).append("\"");
  };
  if (frame.hash) append_hash("hash", *frame.hash);
  if (frame.proof) {
    append_hash("previous", frame.proof->previous);
    append_hash("inputs", frame.proof->inputs);
    append_hash("roster", frame.proof->roster);
    append_hash("rules", frame.proof->rules);
    out += ",\"link\":" + std::to_string(frame.proof->tick);
    append_hash("generator", frame.proof->generator);
  }
  return out + "}\n";
}

void check_server_line(std::string_view line, const std::vector<Column>& fields, Format format) {
  const auto message = decode_server(line, fields, format);
  if (!message) return check(message.error());
  const auto* frame = std::get_if<Frame>(&*message);
  if (frame != nullptr) {
    demand(frame->values.size() == frame->rows() * fields.size(), "a frame's rows are whole");
    demand(std::all_of(frame->values.begin(), frame->values.end(), [](double v) { return std::isfinite(v); }),
           "a frame's values are finite");
  }
  const std::string text = frame != nullptr ? frame_text(*frame, fields, format) : encode(*message);
  if (text.empty()) return;
  demand_one_line(text);
  const auto again = decode_server(text, fields, format);
  demand(again.has_value(), "what is written can be read", text);
  demand(*again == *message, "what is written reads back the same", text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string_view line(reinterpret_cast<const char*>(data) + 1, size - 1);
  line = line.substr(0, line.find('\n'));  // the framer's lines hold none
  switch (data[0]) {
    case 'c':
      check_client_line(line);
      break;
    case 'q':
      check_server_line(line, default_columns(), Format::kQuantized);
      break;
    case 'e':
      check_server_line(line, default_columns(), Format::kExact);
      break;
    case 'a':
      check_server_line(line, all_columns(), Format::kExact);
      break;
    default:
      break;
  }
  return 0;
}
