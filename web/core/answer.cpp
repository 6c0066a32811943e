#include "web/core/answer.h"

namespace woodlouse::web {
namespace {

std::string last;

}  // namespace

std::string& answer() {
  last.clear();
  return last;
}

int refuse(const core::Error& error) {
  answer() = error.text();
  return 0;
}

/// Where the last answer's bytes are, UTF-8; until the next call that answers.
WOODLOUSE_EXPORT(answer_at) const char* answer_at() { return last.data(); }
/// [bytes]
WOODLOUSE_EXPORT(answer_size) std::size_t answer_size() { return last.size(); }

}  // namespace woodlouse::web
