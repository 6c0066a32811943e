// 1e8 louse-steps (quick: 1e6) of a thousand lice that are pushed about between walls, by the server's own
// step: whether anything ever became infinite, left the domain, or grew without end.
#pragma once

#include <filesystem>

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

core::Expected<Table> soak(const std::filesystem::path& folder, Effort effort);

}  // namespace woodlouse::lab
