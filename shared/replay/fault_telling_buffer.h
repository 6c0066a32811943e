// Stream buffers that say why their bytes ended: a read error, damage, a bomb. A std::filebuf throws instead,
// out of whoever reads it without a stream's own guard.
#pragma once

#include <istream>
#include <streambuf>
#include <string>

namespace woodlouse::replay {

class FaultTellingBuffer : public std::streambuf {
 public:
  /// Why the bytes ended before their end, in words; empty: they did not.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 protected:
  std::string fault_;
};

/// The same of the stream's buffer; empty for a buffer of another kind.
inline std::string fault_of(const std::istream& in) {
  const auto* buffer = dynamic_cast<const FaultTellingBuffer*>(in.rdbuf());
  return buffer != nullptr ? buffer->fault() : std::string();
}

}  // namespace woodlouse::replay
