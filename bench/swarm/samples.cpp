#include "bench/swarm/samples.h"

#include <algorithm>
#include <cmath>

namespace woodlouse::swarm {

void Samples::sort() { std::sort(milliseconds_.begin(), milliseconds_.end()); }

double Samples::at(double share) const {
  if (milliseconds_.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(milliseconds_.size())));
  return static_cast<double>(milliseconds_[std::clamp<std::size_t>(rank, 1, milliseconds_.size()) - 1]);
}

}  // namespace woodlouse::swarm
