// The streams that recordings are read by: the standard library's, which bring its locales along; built for a
// browser (WOODLOUSE_FREESTANDING), where each kilobyte is loaded first, what of them is used here.
#pragma once

#include <ios>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#ifdef WOODLOUSE_FREESTANDING
#include <algorithm>
#else
#include <istream>
#include <streambuf>
#endif

namespace woodlouse::replay {

#ifndef WOODLOUSE_FREESTANDING
using StreamBuffer = std::streambuf;
using InputStream = std::istream;
#else
/// As std::streambuf's get area, in its names.
class StreamBuffer {
 public:
  using traits_type = std::char_traits<char>;
  using int_type = traits_type::int_type;
  using pos_type = std::streampos;
  using off_type = std::streamoff;

  StreamBuffer() = default;
  StreamBuffer(const StreamBuffer&) = delete;
  StreamBuffer& operator=(const StreamBuffer&) = delete;
  virtual ~StreamBuffer() = default;

  int_type sgetc() {
    if (next_ == end_ && underflow() == traits_type::eof()) return traits_type::eof();
    return traits_type::to_int_type(*next_);
  }
  int_type sbumpc() {
    if (next_ == end_ && underflow() == traits_type::eof()) return traits_type::eof();
    return traits_type::to_int_type(*next_++);
  }
  std::streamsize sgetn(char* to, std::streamsize size) {
    std::streamsize done = 0;
    while (done < size && (next_ != end_ || underflow() != traits_type::eof())) {
      const auto part = std::min<std::streamsize>(size - done, end_ - next_);
      std::copy_n(next_, part, to + done);
      next_ += part;
      done += part;
    }
    return done;
  }
  pos_type pubseekoff(off_type offset, std::ios_base::seekdir from) {
    return seekoff(offset, from, std::ios_base::in);
  }
  pos_type pubseekpos(pos_type position) { return seekpos(position, std::ios_base::in); }

 protected:
  [[nodiscard]] char* eback() const { return begin_; }
  [[nodiscard]] char* gptr() const { return next_; }
  [[nodiscard]] char* egptr() const { return end_; }
  void gbump(int count) { next_ += count; }
  void setg(char* begin, char* next, char* end) {
    begin_ = begin;
    next_ = next;
    end_ = end;
  }
  virtual int_type underflow() = 0;
  virtual pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) = 0;
  virtual pos_type seekpos(pos_type position, std::ios_base::openmode which) = 0;

 private:
  char *begin_ = nullptr, *next_ = nullptr, *end_ = nullptr;
};

/// As std::istream, in its names.
class InputStream {
 public:
  explicit InputStream(StreamBuffer* buffer) : buffer_(buffer) {}
  InputStream(const InputStream&) = delete;
  InputStream& operator=(const InputStream&) = delete;
  virtual ~InputStream() = default;

  [[nodiscard]] StreamBuffer* rdbuf() const { return buffer_; }
  void rdbuf(StreamBuffer* buffer) { buffer_ = buffer; }
  void clear() { has_failed_ = false; }
  [[nodiscard]] bool fail() const { return has_failed_; }
  InputStream& read(char* to, std::streamsize size) {
    count_ = has_failed_ ? 0 : buffer_->sgetn(to, size);
    has_failed_ = has_failed_ || count_ < size;
    return *this;
  }
  [[nodiscard]] std::streamsize gcount() const { return count_; }
  InputStream& seekg(std::streamoff offset, std::ios_base::seekdir from = std::ios_base::beg) {
    if (!has_failed_) has_failed_ = buffer_->pubseekoff(offset, from) == std::streampos(std::streamoff(-1));
    return *this;
  }
  [[nodiscard]] std::streampos tellg() {
    return has_failed_ ? std::streampos(std::streamoff(-1)) : buffer_->pubseekoff(0, std::ios_base::cur);
  }

 private:
  StreamBuffer* buffer_;
  std::streamsize count_ = 0;
  bool has_failed_ = false;
};
#endif

/// A buffer's bytes many at a time, without a copy: a line's end is looked for among them.
class GetArea : private StreamBuffer {
 public:
  /// Those that lie there, read anew where there are none; empty at the end. Until the buffer's next read.
  static std::string_view of(StreamBuffer& buffer) {
    if (buffer.sgetc() == traits_type::eof()) return {};
    const char* const next = (buffer.*&GetArea::gptr)();
    return {next, static_cast<std::size_t>((buffer.*&GetArea::egptr)() - next)};
  }
  /// Takes so many of them, at most 2^30.
  static void take(StreamBuffer& buffer, std::size_t count) {
    (buffer.*&GetArea::gbump)(static_cast<int>(count));
  }
};

/// Says why its bytes ended: a read error, damage, a bomb. A std::filebuf throws instead, out of whoever
/// reads it without a stream's own guard.
class FaultTellingBuffer : public StreamBuffer {
 public:
  /// Why the bytes ended before their end, in words; empty: they did not.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// The bytes ended where their own form says that more were to come: whoever wrote them was interrupted.
  [[nodiscard]] virtual bool is_cut_off() const { return false; }

 protected:
  std::string fault_;
};

/// The same of the stream's buffer; empty for a buffer of another kind.
inline std::string fault_of(const InputStream& in) {
  const auto* buffer = dynamic_cast<const FaultTellingBuffer*>(in.rdbuf());
  return buffer != nullptr ? buffer->fault() : std::string();
}

/// False for a buffer of another kind.
inline bool is_cut_off(const InputStream& in) {
  const auto* buffer = dynamic_cast<const FaultTellingBuffer*>(in.rdbuf());
  return buffer != nullptr && buffer->is_cut_off();
}

/// Owns the buffer that it reads through.
template <typename Buffer>
class BufferStream final : public InputStream {
 public:
  template <typename Argument>
  explicit BufferStream(Argument&& argument)
      : InputStream(nullptr), buffer_(std::forward<Argument>(argument)) {
    rdbuf(&buffer_);
    clear();
  }

 private:
  Buffer buffer_;
};

/// Bytes in memory, which several may read.
class BytesBuffer final : public StreamBuffer {
 public:
  explicit BytesBuffer(std::shared_ptr<const std::string> bytes) : bytes_(std::move(bytes)) {
    char* const begin = const_cast<char*>(bytes_->data());  // a get area is not written to
    setg(begin, begin, begin + bytes_->size());
  }

 protected:
  int_type underflow() override {
    return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override {
    const off_type base = from == std::ios_base::cur   ? gptr() - eback()
                          : from == std::ios_base::end ? egptr() - eback()
                                                       : 0;
    return seekpos(base + offset, which);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode) override {
    const off_type at = position;
    if (at < 0 || at > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + at, egptr());
    return position;
  }

 private:
  std::shared_ptr<const std::string> bytes_;
};
using BytesStream = BufferStream<BytesBuffer>;

}  // namespace woodlouse::replay
