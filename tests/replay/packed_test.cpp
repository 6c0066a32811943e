// Recordings of zstd frames: whole, cut off anywhere, damaged, or made to do harm.
#include <zstd.h>

#include <catch2/catch.hpp>
#include <memory>
#include <sstream>
#include <string>

#include "shared/core/random.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/writer.h"
#include "shared/replay/zstd_input.h"
#include "shared/replay/zstd_packer.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

std::string unpacked(const std::string& packed) {
  ZstdInput buffer(std::make_unique<std::istringstream>(packed));
  std::istream in(&buffer);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string packed_by_zstd(const std::string& text) {
  std::string out(ZSTD_compressBound(text.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), 1));
  return out;
}

core::Expected<Verification> verify_bytes(const std::string& bytes, unsigned jobs = 1) {
  return verify(ReplaySource::of_bytes(bytes, "r.zst"), jobs);
}

}  // namespace

TEST_CASE(
    "a packed recording is the plain one in zstd frames, one a keyframe, with zstd's own table of them") {
  const Scenario scenario{.seed = 2, .steps = 300};
  const Recording packed = record_packed(scenario);
  const Recording plain = record(scenario);
  CHECK(unpacked(packed.bytes) == plain.bytes);
  // Each frame alone, as zstd itself sees it.
  std::string text;
  std::size_t frames = 0;
  for (std::size_t at = 0; at < packed.bytes.size();) {
    const std::size_t size = ZSTD_findFrameCompressedSize(packed.bytes.data() + at, packed.bytes.size() - at);
    REQUIRE_FALSE(ZSTD_isError(size));
    const std::string piece = unpacked(packed.bytes.substr(at, size));
    if (frames > 0 && frames < 7) CHECK(piece.compare(0, 12, "{\"keyframe\":") == 0);
    text += piece;
    at += size;
    ++frames;
  }
  CHECK(text == plain.bytes);
  CHECK(frames == 1 + 6 + 1 + 1);  // header, keyframes 0 to 300, index, table
  CHECK(packed.bytes.substr(packed.bytes.size() - 4) == "\xB1\xEA\x92\x8F");
}

TEST_CASE("any byte of a packed recording is found by seeking, with the table and without") {
  const Recording packed = record_packed({.seed = 3, .steps = 300});
  const std::string text = unpacked(packed.bytes);
  core::Random random(4);
  for (const std::size_t cut : {std::size_t{0}, std::size_t{1}}) {
    ZstdInput buffer(std::make_unique<std::istringstream>(packed.bytes.substr(0, packed.bytes.size() - cut)));
    std::istream in(&buffer);
    for (int round = 0; round < 200; ++round) {
      const std::size_t at = random.next() % text.size();
      in.clear();
      in.seekg(static_cast<std::streamoff>(at));
      REQUIRE(in.get() == static_cast<unsigned char>(text[at]));
      REQUIRE(in.tellg() == static_cast<std::streamoff>(at + 1));
    }
    in.seekg(0, std::ios::end);
    CHECK(in.tellg() == static_cast<std::streamoff>(text.size()));
  }
}

TEST_CASE("text that is all there is one frame, of whatever size, proven by a checksum") {
  core::Random random(3);
  for (const std::size_t size : {0u, 1u, 1500u, 1u << 17, (1u << 20) + 1, 3u << 20}) {
    INFO(size << " bytes");
    std::string text;
    while (text.size() < size) text += std::to_string(random.next() % 1000) + ",\n";
    text.resize(size);
    std::string frame = FramePacker::whole_frame(text);
    CHECK(unpacked(frame) == text);
    CHECK(ZSTD_findFrameCompressedSize(frame.data(), frame.size()) == frame.size());
    CHECK(10 * frame.size() < 6 * text.size() + 320);
    frame.back() ^= 1;  // of the checksum
    ZstdInput buffer(std::make_unique<std::istringstream>(frame));
    std::istream in(&buffer);
    while (in.get() != std::istream::traits_type::eof()) {
    }
    CHECK_FALSE(buffer.fault().empty());
  }
}

TEST_CASE("a packed recording that breaks off anywhere verifies up to there, at least to its last flush") {
  const Recording packed = record_packed({.seed = 4, .steps = 130});
  const std::size_t first = unpacked(packed.bytes.substr(0, 1)).size();
  CHECK(first == 0);
  std::uint64_t before = 0;
  for (std::size_t length = 0; length < packed.bytes.size(); length += 37) {
    const auto verification = verify_bytes(packed.bytes.substr(0, length));
    INFO(length);
    if (!verification) {
      CHECK(before == 0);
      continue;
    }
    CHECK(verification->ok());
    CHECK(verification->ticks >= before);
    before = verification->ticks;
  }
  CHECK(before == 130);
  const auto jobs = verify_bytes(packed.bytes.substr(0, packed.bytes.size() / 2), 3);
  REQUIRE(jobs);
  CHECK(jobs->ok());
  CHECK(jobs->cut_off);
}

TEST_CASE("a packed recording whose last frame has no end is no complete one") {
  const Recording packed = record_packed({.seed = 4, .steps = 130});
  const auto whole = verify_bytes(packed.bytes);
  REQUIRE(whole);
  CHECK_FALSE(whole->cut_off);
  const std::string skips{"\x50\x2a\x4d\x18\xff\xff\xff\xff", 8};  // 4 GiB that are not there
  for (const std::string& bytes : {packed.bytes.substr(0, packed.bytes.size() - 1), packed.bytes + skips,
                                   packed_by_zstd(record({.seed = 4, .steps = 130}).bytes) + skips}) {
    for (const unsigned jobs : {1u, 3u}) {
      const auto verification = verify_bytes(bytes, jobs);
      REQUIRE(verification);
      CHECK(verification->ok());
      CHECK(verification->cut_off);
    }
  }
  const auto cut = verify_bytes(packed.bytes.substr(0, 20));
  CHECK(cut.error().text().find("it was cut off in the header") != std::string::npos);
}

TEST_CASE("a frame that wants more memory than there is for it is no damaged one") {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, 27);
  const std::string text = record({.steps = 10}).bytes;
  std::string frame(ZSTD_compressBound(text.size()), '\0');
  ZSTD_outBuffer out{frame.data(), frame.size(), 0};
  ZSTD_inBuffer in{text.data(), text.size(), 0};
  REQUIRE_FALSE(ZSTD_isError(ZSTD_compressStream2(context.get(), &out, &in, ZSTD_e_continue)));
  while (ZSTD_compressStream2(context.get(), &out, &in, ZSTD_e_end) != 0) {
  }
  frame.resize(out.pos);
  CHECK(verify_bytes(frame).error().text().find("pack it again without --long") != std::string::npos);
}

TEST_CASE("an altered bit of a packed recording is an error, never another game") {
  const Recording packed = record_packed({.seed = 5, .steps = 130});
  core::Random random(6);
  std::size_t refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string altered = packed.bytes;
    const std::size_t at = random.next() % altered.size();
    altered[at] = static_cast<char>(altered[at] ^ (1 << random.next() % 8));
    const auto verification = verify_bytes(altered, 1u + static_cast<unsigned>(round % 2));
    if (!verification) ++refused;
    if (verification && verification->ok() && !verification->cut_off) CHECK(verification->ticks == 130);
  }
  CHECK(refused > 200);
}

TEST_CASE("a frame, and a file for its size, unpack to so much and no more") {
  const auto fault_of = [](const std::string& packed, std::size_t& size) {
    ZstdInput buffer(std::make_unique<std::istringstream>(packed));
    size = 0;
    std::string chunk(1u << 16, '\0');
    for (std::streamsize count = 1; count > 0; size += static_cast<std::size_t>(count))
      count = buffer.sgetn(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    return buffer.fault();
  };
  std::size_t size = 0;
  CHECK(fault_of(packed_by_zstd(std::string(65u << 20, ' ')), size).find("unpacks to more than 64 MiB") !=
        std::string::npos);
  CHECK(size <= ZstdInput::kMaxFrameBytes);
  const std::string frame = packed_by_zstd(std::string(8u << 20, ' '));
  std::string frames;
  for (int k = 0; k < 20; ++k) frames += frame;
  CHECK(fault_of(frames, size).find("unpacks to more than 100 times ") == 0);
  CHECK(size <= ZstdInput::kMaxFrameBytes + ZstdInput::kMaxRatio * frames.size());
  CHECK(fault_of(frames.substr(0, 8 * frame.size()), size).empty());
  CHECK(size == ZstdInput::kMaxFrameBytes);
}

TEST_CASE("bombs are refused in one line") {
  const Recording recording = record({.steps = 1});
  const std::string start = recording.lines[0] + recording.lines[1];
  const auto error = [](const std::string& bytes) {
    const auto verification = verify_bytes(bytes);
    REQUIRE_FALSE(verification);
    const std::string text = verification.error().text();
    CHECK(text.find('\n') == std::string::npos);
    return text;
  };
  CHECK(error(packed_by_zstd(start) + packed_by_zstd(std::string(40u << 20, ' '))) ==
        "r.zst:3: a line longer than 32 MiB");
  CHECK(error(packed_by_zstd(std::string(40u << 20, '{'))).find("a line longer than 32 MiB") !=
        std::string::npos);
  std::string chats;
  const std::string chat =
      "{\"chat\":0,\"player\":1,\"name\":\"\",\"text\":\"" + std::string(4000, 'x') + "\"}\n";
  for (int k = 0; k < 5000; ++k) chats += chat;
  CHECK(error(packed_by_zstd(start + chats)).find("r.zst:4099: chat: more than 4096 lines") == 0);
  CHECK(error(packed_by_zstd(start + std::string(100000, '[') + "\n")).find("r.zst:3: nested more than") ==
        0);
  CHECK(error(packed_by_zstd(start) + "garbage").find("compressed data is damaged at byte ") !=
        std::string::npos);
  // A window that would need 2 GiB.
  CHECK(error(std::string("\x28\xB5\x2F\xFD\x00\xA8", 6) + std::string(100, '\0'))
            .find("r.zst:1: the compressed frame at byte 0 wants more than 8 MiB") == 0);
}

}  // namespace woodlouse::replay
