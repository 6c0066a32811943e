#include "shared/replay/zstd_packer.h"

#include <cassert>

#include "shared/core/allocation.h"

namespace woodlouse::replay {

FramePacker::Context FramePacker::make_context(int level) {
  Context context(ZSTD_createCCtx());
  if (!context) core::out_of_memory();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, kWindowLog);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  return context;
}

FramePacker::FramePacker() : context_(make_context(kLevel)), buffer_(ZSTD_CStreamOutSize()) {}

std::string FramePacker::whole_frame(std::string_view text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(make_context(kWholeLevel).get(), packed.data(), packed.size(), text.data(), text.size());
  assert(ZSTD_isError(size) == 0);  // as below
  packed.resize(size);
  return packed;
}

void FramePacker::pack(std::string& out, std::string_view text, ZSTD_EndDirective directive) {
  ZSTD_inBuffer in{text.data(), text.size(), 0};
  frame_.unpacked += static_cast<std::uint32_t>(text.size());
  for (;;) {
    ZSTD_outBuffer packed{buffer_.data(), buffer_.size(), 0};
    const std::size_t left = ZSTD_compressStream2(context_.get(), &packed, &in, directive);
    assert(ZSTD_isError(left) ==
           0);  // the parameters are sound: only memory can fail, and that throws elsewhere
    out.append(buffer_.data(), packed.pos);
    frame_.packed += static_cast<std::uint32_t>(packed.pos);
    const bool is_done = directive == ZSTD_e_continue ? in.pos == in.size : left == 0;
    if (is_done) return;
  }
}

void FramePacker::append(std::string& out, std::string_view text) { pack(out, text, ZSTD_e_continue); }

void FramePacker::flush(std::string& out) {
  if (frame_.unpacked != 0) pack(out, {}, ZSTD_e_flush);
}

void FramePacker::end_frame(std::string& out) {
  if (frame_.unpacked == 0) return;
  pack(out, {}, ZSTD_e_end);
  frames_.push_back(frame_);
  frame_ = {};
}

void FramePacker::finish(std::string& out) {
  end_frame(out);
  append_zstd_table(out, frames_);
}

}  // namespace woodlouse::replay
