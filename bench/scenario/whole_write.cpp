#include "bench/scenario/whole_write.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

namespace woodlouse::scenario {

std::optional<core::Error> write_whole_file(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path beside = file.string() + ".new";
  {
    std::ofstream out(beside, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out)
      return core::Error{beside.string(), std::string("can't be written: ") + std::strerror(errno), {}};
  }
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error) return core::Error{file.string(), "can't be replaced: " + error.message(), {}};
  return std::nullopt;
}

}  // namespace woodlouse::scenario
