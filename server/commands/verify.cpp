#include "server/commands/verify.h"

#include <ostream>

#include "shared/replay/parallel_verify.h"
#include "shared/replay/source_file.h"

namespace woodlouse::server {

int verify_command(const std::vector<std::filesystem::path>& files, unsigned jobs, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : files) {
    const core::Expected<replay::Verification> verification =
        replay::verify(replay::source_of_file(file), jobs);
    if (verification && files.size() > 1) out << file.string() << ": ";
    out << (verification ? replay::to_text(*verification) : verification.error().text() + "\n") << std::flush;
    if (!verification || !verification->ok()) exit_code = 1;
  }
  return exit_code;
}

}  // namespace woodlouse::server
