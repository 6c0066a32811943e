// The batched step compiled for any machine.
#include "shared/core/lanes_scalar.h"
#include "shared/physics/batch_kernel.h"

namespace woodlouse::physics {

BatchStep find_scalar_step(bool drag, bool friction, bool thrust) {
  return choose_kernel<core::Lanes1>(drag, friction, thrust);
}

}  // namespace woodlouse::physics
