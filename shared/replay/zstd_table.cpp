#include "shared/replay/zstd_table.h"

#include <array>
#include <cstddef>
#include <span>

namespace woodlouse::replay {
namespace {

constexpr std::uint32_t kSkippableMagic = 0x184D2A5Eu;
constexpr std::uint32_t kSeekableMagic = 0x8F92EAB1u;
constexpr std::size_t kHeaderBytes = 8;
constexpr std::size_t kEntryBytes = 8;
constexpr std::size_t kFooterBytes = 9;  // number of frames, descriptor, magic
constexpr std::uint32_t kMaxFrames = 1u << 22;

void append_u32(std::string& out, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) out += static_cast<char>(value >> (8 * k));
}

std::uint32_t u32_at(std::span<const char> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  }
  return value;
}

bool read_at(std::istream& in, std::uint64_t at, std::span<char> bytes) {
  in.clear();
  in.seekg(static_cast<std::streamoff>(at));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<std::size_t>(in.gcount()) == bytes.size();
}

}  // namespace

void append_zstd_table(std::string& out, const std::vector<ZstdFrameSize>& frames) {
  append_u32(out, kSkippableMagic);
  append_u32(out, static_cast<std::uint32_t>(frames.size() * kEntryBytes + kFooterBytes));
  for (const ZstdFrameSize& frame : frames) {
    append_u32(out, frame.packed);
    append_u32(out, frame.unpacked);
  }
  append_u32(out, static_cast<std::uint32_t>(frames.size()));
  out += '\0';
  append_u32(out, kSeekableMagic);
}

std::optional<ZstdTable> read_zstd_table(std::istream& packed) {
  packed.clear();
  packed.seekg(0, std::ios::end);
  const auto end = static_cast<std::streamoff>(packed.tellg());
  std::array<char, kFooterBytes> footer{};
  if (end < static_cast<std::streamoff>(kHeaderBytes + kFooterBytes)) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(end);
  if (!read_at(packed, size - kFooterBytes, footer)) return std::nullopt;
  const std::uint32_t count = u32_at(footer, 0);
  if (u32_at(footer, 5) != kSeekableMagic || footer[4] != 0 || count > kMaxFrames) return std::nullopt;
  const std::size_t bytes = kHeaderBytes + count * kEntryBytes + kFooterBytes;
  if (bytes > size) return std::nullopt;
  std::vector<char> table(bytes);
  if (!read_at(packed, size - bytes, table)) return std::nullopt;
  if (u32_at(table, 0) != kSkippableMagic || u32_at(table, 4) != bytes - kHeaderBytes) return std::nullopt;

  ZstdTable result;
  std::uint64_t at = 0;
  for (std::size_t k = 0; k < count; ++k) {
    result.frames.push_back({at, result.unpacked});
    at += u32_at(table, kHeaderBytes + k * kEntryBytes);
    result.unpacked += u32_at(table, kHeaderBytes + k * kEntryBytes + 4);
  }
  if (at != size - bytes) return std::nullopt;
  return result;
}

}  // namespace woodlouse::replay
