// Stream buffers that say why their bytes ended: a read error, damage, a bomb. A std::filebuf throws instead,
// out of whoever reads it without a stream's own guard.
#pragma once

#include <istream>
#include <streambuf>
#include <string>
#include <utility>

namespace woodlouse::replay {

class FaultTellingBuffer : public std::streambuf {
 public:
  /// Why the bytes ended before their end, in words; empty: they did not.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// The bytes ended where their own form says that more were to come: whoever wrote them was interrupted.
  [[nodiscard]] virtual bool is_cut_off() const { return false; }

 protected:
  std::string fault_;
};

/// The same of the stream's buffer; empty for a buffer of another kind.
inline std::string fault_of(const std::istream& in) {
  const auto* buffer = dynamic_cast<const FaultTellingBuffer*>(in.rdbuf());
  return buffer != nullptr ? buffer->fault() : std::string();
}

/// False for a buffer of another kind.
inline bool is_cut_off(const std::istream& in) {
  const auto* buffer = dynamic_cast<const FaultTellingBuffer*>(in.rdbuf());
  return buffer != nullptr && buffer->is_cut_off();
}

/// Owns the buffer that it reads through.
template <typename Buffer>
class BufferStream final : public std::istream {
 public:
  template <typename Argument>
  explicit BufferStream(Argument&& argument)
      : std::istream(nullptr), buffer_(std::forward<Argument>(argument)) {
    rdbuf(&buffer_);
  }

 private:
  Buffer buffer_;
};

}  // namespace woodlouse::replay
