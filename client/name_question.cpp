#include "client/name_question.h"

#include <cassert>

#include "shared/core/printable.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {
namespace {

std::string without_blanks(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? std::string()
                                    : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

}  // namespace

std::optional<std::string> ask_for_name(const std::string& suggestion, std::istream& in, std::ostream& out) {
  assert(!suggestion.empty() && suggestion.size() <= protocol::kMaxNameBytes);
  out << "What is your louse called? [" << suggestion << "] " << std::flush;
  for (std::string line; std::getline(in, line);) {
    const std::string name = without_blanks(line);
    if (name.empty()) return suggestion;
    if (name.size() <= protocol::kMaxNameBytes && core::printable(name) == name) return name;
    out << (name.size() > protocol::kMaxNameBytes ? "At most 24 bytes, please: "
                                                  : "In characters that can be seen, please: ")
        << std::flush;
  }
  return std::nullopt;
}

}  // namespace woodlouse::client
