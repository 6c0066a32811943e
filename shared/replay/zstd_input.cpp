#include "shared/replay/zstd_input.h"

#include <zstd_errors.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "shared/core/allocation.h"
#include "shared/core/joined.h"
#include "shared/replay/zstd_table.h"

namespace woodlouse::replay {
namespace {

/// Of the frames found by unpacking, one is kept for so much text: a file of empty frames takes no memory.
constexpr std::uint64_t kFoundFrameBytes = 1u << 16;

std::string fault_at(std::uint64_t at, std::size_t error) {
  const std::string byte = std::to_string(at);
  if (ZSTD_getErrorCode(error) == ZSTD_error_frameParameter_windowTooLarge) {
    return core::joined({"the compressed frame at byte ", byte, " wants more than ",
                         std::to_string(1u << (ZstdInput::kMaxWindowLog - 20)),
                         " MiB of memory to be unpacked: pack it again without --long or --ultra"});
  }
  return core::joined({"compressed data is damaged at byte ", byte, ": ", ZSTD_getErrorName(error)});
}

}  // namespace

ZstdInput::ZstdInput(std::unique_ptr<InputStream> packed, std::size_t buffer_bytes)
    : packed_(std::move(packed)), context_(ZSTD_createDCtx()), in_(buffer_bytes), out_(buffer_bytes) {
  assert(buffer_bytes > 0);
  if (!context_) core::out_of_memory();
  ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kMaxWindowLog);
  if (std::optional<ZstdTable> table = read_zstd_table(*packed_)) {
    frames_ = std::move(table->frames);
    total_ = frames_.back().unpacked;
    has_table_ = has_frames_ = true;
  }
  restart({});
}

std::uint64_t ZstdInput::position() const {
  return unpacked_end_ - static_cast<std::uint64_t>(egptr() - gptr());
}

bool ZstdInput::refill_packed() {
  if (pending_.pos < pending_.size) return true;
  packed_->clear();
  packed_->read(in_.data(), static_cast<std::streamsize>(in_.size()));
  pending_ = {in_.data(), static_cast<std::size_t>(packed_->gcount()), 0};
  packed_read_ += pending_.size;
  if (pending_.size == 0) fault_ = fault_of(*packed_);
  return pending_.size > 0;
}

/// Makes the next bytes the get area; false at the end, or at a fault.
bool ZstdInput::unpack_some() {
  while (fault_.empty()) {
    // What is flushed may stand in zstd still when the file has no more bytes.
    const bool has_more = refill_packed();
    if (!fault_.empty()) return false;
    if (!has_more && is_drained_) return false;
    const std::uint64_t at = packed_read_ - (pending_.size - pending_.pos);
    if (!is_frame_open_) {
      if (!has_more) return false;
      frame_ = {at, unpacked_end_};
      is_frame_open_ = true;
      if (!has_frames_ && (frames_.empty() || frame_.unpacked - frames_.back().unpacked >= kFoundFrameBytes))
        frames_.push_back(frame_);
    }
    ZSTD_outBuffer out{out_.data(), out_.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context_.get(), &out, &pending_);
    if (ZSTD_isError(left) != 0) {
      fault_ = fault_at(at, left);
      return false;
    }
    if (left == 0) is_frame_open_ = false;
    unpacked_end_ += out.pos;
    if (unpacked_end_ - frame_.unpacked > kMaxFrameBytes) {
      fault_ = core::joined({"the compressed frame at byte ", std::to_string(frame_.packed),
                             " unpacks to more than ", std::to_string(kMaxFrameBytes >> 20),
                             " MiB: no recording"});
      return false;
    }
    if (unpacked_end_ > kMaxFrameBytes + kMaxRatio * packed_read_) {
      fault_ = core::joined({"unpacks to more than ", std::to_string(kMaxRatio), " times ",
                             std::to_string(packed_read_), " bytes: no recording"});
      return false;
    }
    if (has_table_ && !check_frame_end()) return false;
    setg(out_.data(), out_.data(), out_.data() + out.pos);
    if (out.pos > 0) return true;
    if (!has_more) is_drained_ = true;
  }
  return false;
}

/// The frame being read goes as far as the table says, and no further.
bool ZstdInput::check_frame_end() {
  const auto next = std::upper_bound(frames_.begin(), frames_.end(), frame_.packed,
                                     [](std::uint64_t at, const ZstdFrame& f) { return at < f.packed; });
  if (next == frames_.end()) return true;  // the table itself
  const std::uint64_t packed_end = packed_read_ - (pending_.size - pending_.pos);
  const bool fits = is_frame_open_ ? unpacked_end_ <= next->unpacked
                                   : unpacked_end_ == next->unpacked && packed_end == next->packed;
  if (!fits) {
    fault_ = core::joined({"the table of frames at its end says that the one at byte ",
                           std::to_string(frame_.packed), " unpacks to ",
                           std::to_string(next->unpacked - frame_.unpacked), " bytes, it unpacks to ",
                           is_frame_open_ ? "more" : std::to_string(unpacked_end_ - frame_.unpacked)});
  }
  return fits;
}

ZstdInput::int_type ZstdInput::underflow() {
  if (gptr() == egptr() && !unpack_some()) {
    setg(out_.data(), out_.data(), out_.data());
    return traits_type::eof();
  }
  return traits_type::to_int_type(*gptr());
}

void ZstdInput::restart(const ZstdFrame& frame) {
  ZSTD_DCtx_reset(context_.get(), ZSTD_reset_session_only);
  packed_->clear();
  packed_->seekg(static_cast<std::streamoff>(frame.packed));
  packed_read_ = frame.packed;
  pending_ = {in_.data(), 0, 0};
  unpacked_end_ = frame.unpacked;
  is_frame_open_ = false;
  is_drained_ = false;
  fault_.clear();
  setg(out_.data(), out_.data(), out_.data());
}

/// By unpacking it all, where no table names them.
void ZstdInput::find_frames() {
  if (has_frames_) return;
  frames_.clear();
  restart({});
  while (unpack_some()) {
  }
  total_ = unpacked_end_;
  has_frames_ = true;
  restart({});
}

ZstdInput::pos_type ZstdInput::seekoff(off_type offset, std::ios_base::seekdir from,
                                       std::ios_base::openmode which) {
  if (from == std::ios_base::cur && offset == 0) return static_cast<off_type>(position());
  std::uint64_t base = from == std::ios_base::cur ? position() : 0;
  if (from == std::ios_base::end) {
    find_frames();
    base = total_;
  }
  return seekpos(static_cast<off_type>(base) + offset, which);
}

ZstdInput::pos_type ZstdInput::seekpos(pos_type position_wanted, std::ios_base::openmode) {
  const off_type wanted = position_wanted;
  if (wanted < 0) return pos_type(off_type(-1));
  const auto target = static_cast<std::uint64_t>(wanted);
  if (target < position() || target > unpacked_end_) {
    find_frames();
    const auto after = std::upper_bound(frames_.begin(), frames_.end(), target,
                                        [](std::uint64_t at, const ZstdFrame& f) { return at < f.unpacked; });
    restart(after == frames_.begin() ? ZstdFrame{} : *(after - 1));
  }
  while (unpacked_end_ < target) {
    setg(out_.data(), out_.data(), out_.data());
    if (!unpack_some()) return pos_type(off_type(-1));
  }
  setg(eback(), egptr() - (unpacked_end_ - target), egptr());
  return position_wanted;
}

}  // namespace woodlouse::replay
