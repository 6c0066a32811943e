#include "shared/replay/source.h"

#include <array>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/map/map_text.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/zstd_input.h"

namespace woodlouse::replay {
namespace {

using core::joined;
using Stream = std::unique_ptr<InputStream>;

/// zstd's frames and its skippable ones begin so.
bool is_compressed(InputStream& in) {
  std::array<unsigned char, 4> magic{};
  in.read(reinterpret_cast<char*>(magic.data()), magic.size());
  in.clear();
  in.seekg(0);
  const bool is_frame = magic == std::array<unsigned char, 4>{0x28, 0xB5, 0x2F, 0xFD};
  const bool is_skippable =
      (magic[0] & 0xF0) == 0x50 && magic[1] == 0x2A && magic[2] == 0x4D && magic[3] == 0x18;
  return is_frame || is_skippable;
}

core::Expected<MapPointer> map_of(const Header& header, const ReplaySource& source, Maps* maps) {
  if (!header.map_definition.empty()) {
    const std::string where = joined({source.name, ":1: map.definition"});
    if (header.map_definition.size() > kMaxInlineMapBytes)
      return core::fail(where, joined({"longer than ", std::to_string(kMaxInlineMapBytes >> 20), " MiB"}),
                        "a server names a larger map by its file");
    const auto parse = [&]() -> core::Expected<MapPointer> {
      return map::parse_canonical_map(header.map_definition, where);
    };
    return maps == nullptr ? parse() : maps->find_or(header.map_definition, parse);
  }
  if (source.find_map) return source.find_map(header);
  return core::fail(joined({source.name, ":1: map.file"}),
                    "is only named, and files are not looked for here");
}

}  // namespace

std::unique_ptr<InputStream> unpacked(std::unique_ptr<InputStream> in) {
  if (!is_compressed(*in)) return in;
  return std::make_unique<BufferStream<ZstdInput>>(std::move(in));
}

ReplaySource ReplaySource::of_bytes(std::string bytes, std::string name) {
  return {std::move(name),
          [bytes = std::make_shared<const std::string>(std::move(bytes))]() -> core::Expected<Stream> {
            return unpacked(std::make_unique<BytesStream>(bytes));
          },
          {}};
}

core::Expected<MapPointer> recorded_map(const Header& header, const ReplaySource& source, Maps* maps) {
  core::Expected<MapPointer> map = map_of(header, source, maps);
  if (map && (*map)->hash != header.map_hash) {
    return core::fail(joined({source.name, ":1: map.hash"}),
                      joined({"the map's hash is ", core::to_hex((*map)->hash), ", recorded is ",
                              core::to_hex(header.map_hash)}),
                      header.map_definition.empty() ? "put the map it was played on beside the recording"
                                                    : "the map in the recording was altered");
  }
  if (map && !(*map)->definition.modes.has(header.mode)) {
    return core::fail(joined({source.name, ":1: mode"}),
                      joined({"the map has no mode ", state::to_text(header.mode)}),
                      "the recording was altered");
  }
  return map;
}

}  // namespace woodlouse::replay
