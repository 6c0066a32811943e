#include "server/commands/verify.h"

#include <ostream>
#include <string>

#include "shared/core/printable.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/source_file.h"

namespace woodlouse::server {

namespace {

/// What was asked for besides, and is not so; empty: nothing.
std::string missing(const VerifyRequest& request, const replay::Verification& verification) {
  if (request.from_start && !verification.from_start())
    return "      --from-start: it does not begin with the beginning of a game\n";
  if (request.complete && verification.cut_off) return "      --complete: it was not finished\n";
  return {};
}

}  // namespace

int verify_command(const VerifyRequest& request, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : request.files) {
    const core::Expected<replay::Verification> verification =
        replay::verify(replay::source_of_file(file, request.maps), request.jobs);
    if (verification && request.files.size() > 1) out << core::printable(file.string()) << ": ";
    out << (verification ? replay::to_text(*verification) : verification.error().text() + "\n");
    const std::string less = verification && verification->ok() ? missing(request, *verification) : "";
    out << less << std::flush;
    if (!verification || !verification->ok() || !less.empty()) exit_code = 1;
  }
  return exit_code;
}

}  // namespace woodlouse::server
