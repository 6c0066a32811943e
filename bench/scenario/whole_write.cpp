#include "bench/scenario/whole_write.h"

#include <string>
#include <system_error>

#include "shared/core/sink_file.h"

namespace woodlouse::scenario {

std::optional<core::Error> write_whole_file(const std::filesystem::path& file, std::string_view text) {
  // A new one: what came beside the file under this name may be a link to anything.
  const std::filesystem::path beside = file.string() + ".new";
  std::error_code error;
  std::filesystem::remove(beside, error);
  const auto created = core::create_file(beside);
  if (!created) return created.error();
  if (auto written = created->sink->write(text); !written) return written.error();
  if (auto closed = created->sink->close(); !closed) return closed.error();
  std::filesystem::rename(created->path, file, error);
  if (error) return core::Error{file.string(), "can't be replaced: " + error.message()};
  return std::nullopt;
}

}  // namespace woodlouse::scenario
