// The table of frames at the end of a packed recording is whoever's wrote it: whatever it says, every way of
// reading gives what unpacking the file from its first byte gives, or a fault.
#include <zstd.h>

#include <catch2/catch.hpp>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/replay/inspect.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/zstd_input.h"
#include "shared/replay/zstd_table.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

/// What zstd itself makes of all frames, one behind the other.
std::string unpacked_by_zstd(const std::string& packed) {
  ZSTD_DCtx* context = ZSTD_createDCtx();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::string text;
  std::string piece(1u << 16, '\0');
  for (bool has_more = true; has_more || in.pos < in.size;) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    REQUIRE_FALSE(ZSTD_isError(ZSTD_decompressStream(context, &out, &in)));
    text.append(piece, 0, out.pos);
    has_more = out.pos == piece.size();
  }
  ZSTD_freeDCtx(context);
  return text;
}

std::string packed_by_zstd(const std::string& text, int level = 1) {
  std::string out(ZSTD_compressBound(text.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), level));
  return out;
}

std::string skippable(const std::string& payload, std::size_t named_bytes) {
  std::string out = "\x50\x2A\x4D\x18";
  for (int k = 0; k < 4; ++k) out += static_cast<char>(named_bytes >> (8 * k));
  return out + payload;
}

ZstdFrameSize size_of(const std::string& frame) {
  return {static_cast<std::uint32_t>(frame.size()),
          static_cast<std::uint32_t>(unpacked_by_zstd(frame).size())};
}

std::vector<std::string> frames_of(const std::string& packed) {
  std::vector<std::string> frames;
  for (std::size_t at = 0; at < packed.size(); at += frames.back().size()) {
    const std::size_t size = ZSTD_findFrameCompressedSize(packed.data() + at, packed.size() - at);
    REQUIRE_FALSE(ZSTD_isError(size));
    frames.push_back(packed.substr(at, size));
  }
  frames.pop_back();  // the table
  return frames;
}

std::vector<ZstdFrameSize> sizes_of(const std::vector<std::string>& frames) {
  std::vector<ZstdFrameSize> sizes;
  for (const std::string& frame : frames) sizes.push_back(size_of(frame));
  return sizes;
}

std::string with_table(const std::vector<std::string>& frames, const std::vector<ZstdFrameSize>& sizes) {
  std::string packed = std::accumulate(frames.begin(), frames.end(), std::string());
  append_zstd_table(packed, sizes);
  return packed;
}

bool is_believed(const std::string& packed) {
  std::istringstream in(packed);
  return read_zstd_table(in).has_value();
}

struct Read {
  std::string text;
  std::string fault;
};

/// From that byte to the end.
Read read_from(const std::string& packed, std::uint64_t at) {
  BufferStream<ZstdInput> in(std::make_unique<std::istringstream>(packed));
  if (at != 0) in.seekg(static_cast<std::streamoff>(at));
  Read read;
  read.text.assign(std::istreambuf_iterator<char>(in.rdbuf()), {});
  read.fault = fault_of(in);
  return read;
}

std::string verdict_of(const std::string& packed, unsigned jobs) {
  const auto verification = verify(ReplaySource::of_bytes(packed, "r.zst"), jobs);
  return verification ? to_text(*verification) : verification.error().text();
}

/// However it is read, it is one text, or a fault. Whether it was read.
bool check_one_text(const std::string& packed, core::Random& random) {
  const std::string text = unpacked_by_zstd(packed);
  const Read whole = read_from(packed, 0);
  const std::string verdict = verdict_of(packed, 1);
  CHECK(verdict_of(packed, 3) == verdict);
  if (!whole.fault.empty()) {
    CHECK(whole.fault.find("the table of frames at its end says that the one at byte ") == 0);
    CHECK(verdict.find("the table of frames at its end says ") != std::string::npos);
    CHECK(text.compare(0, whole.text.size(), whole.text) == 0);
    return false;
  }
  CHECK(whole.text == text);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t at = random.next() % (text.size() + 1);
    const Read rest = read_from(packed, at);
    CHECK(rest.fault.empty());
    REQUIRE(rest.text == text.substr(at));
  }
  return true;
}

/// One step's hash of the frame's text is another.
std::string with_other_hash(const std::string& frame) {
  std::string text = unpacked_by_zstd(frame);
  const std::size_t at = text.find("\"hash\":\"", text.find("{\"step\":")) + 8;
  text[at] = text[at] == '0' ? '1' : '0';
  return packed_by_zstd(text);
}

}  // namespace

TEST_CASE(
    "a table that leads into a skippable frame is not believed, whichever of the two texts is altered") {
  const Recording recording = record_packed({.seed = 2, .steps = 300});
  const std::vector<std::string> frames = frames_of(recording.bytes);
  REQUIRE(frames.size() == 8);
  core::Random random(1);
  for (const bool is_hidden_altered : {false, true}) {
    const std::string other = with_other_hash(frames[3]);
    const std::string& hidden = is_hidden_altered ? other : frames[3];
    const std::string& shown = is_hidden_altered ? frames[3] : other;
    // Unpacked from the front: what is shown; by the table: what is hidden in the skippable frame.
    std::vector<std::string> file = frames;
    file[3] = skippable(hidden + skippable({}, shown.size()), hidden.size() + 8) + shown;
    std::vector<ZstdFrameSize> sizes = sizes_of(frames);
    sizes[2].packed += 8;
    sizes[3] = {static_cast<std::uint32_t>(hidden.size() + 8 + shown.size()), size_of(hidden).unpacked};
    const std::string packed = with_table(file, sizes);
    CHECK_FALSE(is_believed(packed));
    CHECK(check_one_text(packed, random));
    CHECK((verdict_of(packed, 3) == "ok ticks 0 to 300\n") == is_hidden_altered);
    const auto archive = opened(packed);
    const auto state = inspect_state(*archive, 179);
    REQUIRE(state);
    CHECK(state->difference.has_value() == !is_hidden_altered);
  }
}

TEST_CASE("whatever a table says, a recording is read as one text or with a fault, by every reader") {
  const Recording recording = record_packed({.seed = 3, .steps = 200, .keyframe_ticks = 40});
  const std::vector<std::string> frames = frames_of(recording.bytes);
  const std::vector<ZstdFrameSize> right = sizes_of(frames);
  CHECK(with_table(frames, right) == recording.bytes);
  core::Random random(7);
  std::size_t read = 0;
  constexpr int kRounds = 150;
  for (int round = 0; round < kRounds; ++round) {
    INFO("round " << round);
    std::vector<ZstdFrameSize> sizes = right;
    const std::size_t k = random.next() % (sizes.size() - 1);
    const auto by = static_cast<std::uint32_t>(1 + random.next() % 200);
    switch (round % 6) {
      case 0:  // a shorter text, a longer one behind it
        sizes[k].unpacked -= by;
        sizes[k + 1].unpacked += by;
        break;
      case 1:
        sizes[k].unpacked += by;
        break;
      case 2:
        sizes[k].packed -= by;
        sizes[k + 1].packed += by;
        break;
      case 3:  // two frames told as one
        sizes[k].packed += sizes[k + 1].packed;
        sizes[k].unpacked += sizes[k + 1].unpacked;
        sizes.erase(sizes.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        break;
      case 4:
        std::swap(sizes[k], sizes[k + 1]);
        break;
      default:
        sizes[k].unpacked = static_cast<std::uint32_t>(random.next());
        sizes.insert(sizes.begin() + static_cast<std::ptrdiff_t>(k), {0, by});
    }
    const std::string packed = with_table(frames, sizes);
    const bool is_text = check_one_text(packed, random);
    read += is_text ? 1 : 0;
    CHECK(is_text != is_believed(packed));  // every one of them lies
  }
  CHECK(read > kRounds / 3);
  CHECK(read < kRounds);
}

TEST_CASE("a table is believed where it tells the file, of any frames that zstd makes") {
  core::Random random(5);
  std::string noise(300'000, '\0');
  for (char& byte : noise) byte = static_cast<char>(random.next());
  std::vector<std::string> frames;
  for (const std::string& text : {std::string(), std::string(500'000, 'x'), noise, std::string("x"),
                                  noise.substr(0, 70'000) + std::string(70'000, 'y')}) {
    for (const int level : {1, 9}) frames.push_back(packed_by_zstd(text, level));
    for (const int checksum : {0, 1}) {  // by pieces, so that its length is not in its header
      ZSTD_CCtx* context = ZSTD_createCCtx();
      ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, checksum);
      std::string out(ZSTD_compressBound(text.size()) + 1000, '\0');
      ZSTD_outBuffer packed{out.data(), out.size(), 0};
      ZSTD_inBuffer half{text.data(), text.size() / 2, 0};
      CHECK(ZSTD_compressStream2(context, &packed, &half, ZSTD_e_flush) == 0);
      ZSTD_inBuffer rest{text.data(), text.size(), text.size() / 2};
      CHECK(ZSTD_compressStream2(context, &packed, &rest, ZSTD_e_end) == 0);
      ZSTD_freeCCtx(context);
      out.resize(packed.pos);
      frames.push_back(out);
    }
  }
  const std::string packed = with_table(frames, sizes_of(frames));
  CHECK(is_believed(packed));
  CHECK(read_from(packed, 0).fault.empty());
  CHECK(read_from(packed, 600'000).text == unpacked_by_zstd(packed).substr(600'000));
  // With a frame between them that is passed over, as other tools write them, it is read all the same.
  std::vector<std::string> skipping = frames;
  skipping.insert(skipping.begin() + 3, skippable("hello", 5));
  std::vector<ZstdFrameSize> sizes = sizes_of(frames);
  sizes.insert(sizes.begin() + 3, {13, 0});
  CHECK_FALSE(is_believed(with_table(skipping, sizes)));
  CHECK(read_from(with_table(skipping, sizes), 600'000).text == unpacked_by_zstd(packed).substr(600'000));
  // Nor is one that ends within a frame, or goes past them.
  for (const std::size_t cut : {std::size_t{1}, std::size_t{4}, frames.back().size() - 5}) {
    std::vector<std::string> shorter = frames;
    shorter.back().resize(shorter.back().size() - cut);
    std::vector<ZstdFrameSize> cut_sizes = sizes_of(frames);
    cut_sizes.back().packed -= static_cast<std::uint32_t>(cut);
    CHECK_FALSE(is_believed(with_table(shorter, cut_sizes)));
  }
}

TEST_CASE("a jump by the table unpacks no frame that it does not need") {
  const Recording recording = record_packed({.seed = 4, .steps = 1200});  // its end is looked for in 32 KiB
  std::vector<std::string> frames = frames_of(recording.bytes);
  const std::vector<ZstdFrameSize> sizes = sizes_of(frames);
  frames[2][frames[2].size() - 1] ^= 1;  // its checksum
  const auto archive = opened(with_table(frames, sizes));
  CHECK(inspect_state(*archive, 950));
  CHECK_FALSE(inspect_state(*archive, 119));
}

}  // namespace woodlouse::replay
