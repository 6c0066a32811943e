// The framer, against a second, slower way to cut the same stream: whatever the limit, however the stream is
// cut into chunks and whenever lines are taken out, the lines are the same.
//
// Input: a byte for the limit, a byte that seeds the chunks' sizes, the stream.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/random.h"
#include "shared/protocol/framing.h"
#include "tests/fuzz/property.h"

using woodlouse::core::Random;
using woodlouse::fuzz::demand;
using woodlouse::protocol::LineFramer;

namespace {

constexpr std::uint8_t kMaxLimit = 64;

/// A line, or nothing for one that was too long.
using Cut = std::optional<std::string>;

void drain(LineFramer& framer, std::size_t limit, std::vector<Cut>& cuts) {
  while (const auto line = framer.next()) {
    demand(line->text.find('\n') == std::string_view::npos, "a line holds no newline", line->text);
    demand(line->text.size() <= limit, "a line is within the limit", line->text);
    demand(!line->oversize || line->text.empty(), "a line that is too long has no text", line->text);
    cuts.push_back(line->oversize ? Cut() : Cut(std::string(line->text)));
  }
}

/// The whole stream at once. What has no newline yet counts when it is too long already.
std::vector<Cut> expected(std::string_view stream, std::size_t limit) {
  std::vector<Cut> cuts;
  for (std::size_t end = stream.find('\n'); end != std::string_view::npos; end = stream.find('\n')) {
    std::string_view line = stream.substr(0, end);
    stream.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    cuts.push_back(line.size() > limit ? Cut() : Cut(std::string(line)));
  }
  const bool may_fit = stream.size() <= limit || (stream.size() == limit + 1 && stream.ends_with('\r'));
  if (!may_fit) cuts.emplace_back();
  return cuts;
}

enum class Drain : std::uint8_t { kAtOnce, kNowAndThen, kAtTheEnd };

std::vector<Cut> framed(std::string_view stream, std::size_t limit, std::uint64_t seed, Drain when) {
  LineFramer framer(limit);
  Random random(seed);
  std::vector<Cut> cuts;
  while (!stream.empty()) {
    const std::size_t size = std::min<std::size_t>(stream.size(), random.next() % 17);
    framer.append(stream.substr(0, size));
    stream.remove_prefix(size);
    if (when == Drain::kAtOnce || (when == Drain::kNowAndThen && random.next() % 3 == 0))
      drain(framer, limit, cuts);
  }
  drain(framer, limit, cuts);
  return cuts;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t limit = data[0] % kMaxLimit + 1;
  const std::string_view stream(reinterpret_cast<const char*>(data) + 2, size - 2);
  const std::vector<Cut> lines = expected(stream, limit);
  for (const Drain when : {Drain::kAtOnce, Drain::kNowAndThen, Drain::kAtTheEnd}) {
    demand(framed(stream, limit, data[1], when) == lines, "the lines do not depend on the chunks", stream);
  }
  return 0;
}
