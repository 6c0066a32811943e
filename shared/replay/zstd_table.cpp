#include "shared/replay/zstd_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace woodlouse::replay {
namespace {

constexpr std::uint32_t kSkippableMagic = 0x184D2A5Eu;
constexpr std::uint32_t kSeekableMagic = 0x8F92EAB1u;
constexpr std::size_t kHeaderBytes = 8;
constexpr std::size_t kEntryBytes = 8;
constexpr std::size_t kFooterBytes = 9;         // number of frames, descriptor, magic
constexpr std::uint32_t kMaxFrames = 1u << 20;  // sixty days of them

void append_u32(std::string& out, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) out += static_cast<char>(value >> (8 * k));
}

std::uint32_t unsigned_at(std::span<const char> bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < count; ++k) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  }
  return value;
}

std::uint32_t u32_at(std::span<const char> bytes, std::size_t at) { return unsigned_at(bytes, at, 4); }

bool read_at(InputStream& in, std::uint64_t at, std::span<char> bytes) {
  in.clear();
  in.seekg(static_cast<std::streamoff>(at));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<std::size_t>(in.gcount()) == bytes.size();
}

// ---- where frames end ------------------------------------------------------------------------------------

constexpr std::uint32_t kFrameMagic = 0xFD2FB528u;
constexpr std::size_t kMagicBytes = 4;
constexpr std::size_t kBlockHeaderBytes = 3;
constexpr std::size_t kChecksumBytes = 4;

/// Walks from frame to frame by their headers; reads the file once, in large pieces.
class FrameWalk {
 public:
  /// `end`: where the last frame has to end.
  FrameWalk(InputStream& packed, std::uint64_t end) : packed_(packed), end_(end) {}

  /// Goes to the end of the frame that begins here; nothing where none does.
  std::optional<std::uint64_t> pass_frame() {
    const auto head = bytes(kMagicBytes + 1);
    if (!head || u32_at(*head, 0) != kFrameMagic) return std::nullopt;
    const auto descriptor = static_cast<unsigned char>((*head)[kMagicBytes]);
    const bool is_single_segment = (descriptor & 0x20) != 0;
    const bool has_checksum = (descriptor & 0x04) != 0;
    constexpr std::size_t kDictionaryBytes[] = {0, 1, 2, 4};
    const std::size_t content_bytes =
        descriptor >> 6 == 0 ? (is_single_segment ? 1 : 0) : std::size_t{1} << (descriptor >> 6);
    at_ += kMagicBytes + 1 + (is_single_segment ? 0 : 1) + kDictionaryBytes[descriptor & 3] + content_bytes;
    while (const auto is_last = pass_block()) {
      if (!*is_last) continue;
      at_ += has_checksum ? kChecksumBytes : 0;
      return at_ <= end_ ? std::optional(at_) : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  /// Whether it is its frame's last one.
  std::optional<bool> pass_block() {
    const auto header = bytes(kBlockHeaderBytes);
    if (!header) return std::nullopt;
    const std::uint32_t bits = unsigned_at(*header, 0, kBlockHeaderBytes);
    enum : std::uint32_t { kRaw, kRepeated, kCompressed, kReserved };
    const std::uint32_t kind = bits >> 1 & 3;
    if (kind == kReserved) return std::nullopt;
    at_ += kBlockHeaderBytes + (kind == kRepeated ? 1 : bits >> 3);
    return (bits & 1) != 0;
  }

  /// Those that stand here; nothing when there are not so many before the end.
  std::optional<std::span<const char>> bytes(std::size_t count) {
    if (at_ > end_ || end_ - at_ < count) return std::nullopt;
    if (at_ < piece_begin_ || at_ + count > piece_begin_ + piece_.size()) {
      piece_begin_ = at_;
      piece_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kPieceBytes, end_ - at_)));
      if (!read_at(packed_, at_, piece_)) return std::nullopt;
    }
    return std::span<const char>(piece_).subspan(static_cast<std::size_t>(at_ - piece_begin_), count);
  }

  static constexpr std::uint64_t kPieceBytes = 1u << 16;
  InputStream& packed_;
  std::uint64_t end_;
  std::uint64_t at_ = 0;
  std::vector<char> piece_;
  std::uint64_t piece_begin_ = 0;
};

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

std::optional<ZstdTable> read_zstd_table(InputStream& packed) {
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
  ZstdFrame frame;
  FrameWalk walk(packed, size - bytes);
  for (std::size_t k = 0; k < count; ++k) {
    result.frames.push_back(frame);
    frame.packed += u32_at(table, kHeaderBytes + k * kEntryBytes);
    frame.unpacked += u32_at(table, kHeaderBytes + k * kEntryBytes + 4);
    if (walk.pass_frame() != frame.packed) return std::nullopt;
  }
  if (frame.packed != size - bytes) return std::nullopt;
  result.frames.push_back(frame);
  return result;
}

}  // namespace woodlouse::replay
