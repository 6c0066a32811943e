#include "shared/core/sink_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

namespace woodlouse::core {
namespace {

class FileSink final : public ByteSink {
 public:
  FileSink(std::ofstream out, std::string name) : out_(std::move(out)), name_(std::move(name)) {}

  Expected<void> write(std::string_view bytes) override {
    errno = 0;
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out_.flush();
    return outcome();
  }
  Expected<void> close() override {
    errno = 0;
    out_.close();
    return outcome();
  }

 private:
  Expected<void> outcome() const {
    if (!out_) return fail(name_, std::strerror(errno));
    return {};
  }

  std::ofstream out_;
  std::string name_;
};

}  // namespace

Expected<std::unique_ptr<ByteSink>> open_file_sink(const std::filesystem::path& file) {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (!out) return fail(file.string(), std::strerror(errno));
  return std::make_unique<FileSink>(std::move(out), file.string());
}

}  // namespace woodlouse::core
