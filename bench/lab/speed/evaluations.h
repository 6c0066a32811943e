// One evaluation of a surface: ours, other libraries', the document's.
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

core::Expected<void> measure_evaluations(const Output& output);

}  // namespace woodlouse::lab
