#include "server/stream/recorded_step.h"

#include <cassert>

#include "shared/replay/line_writer.h"

namespace woodlouse::server {

const std::string& RecordedStep::line() const {
  std::call_once(is_made_, [this] {
    replay::Margins margins;
    for (const InputMargin& margin : margins_)
      margins[{margin.player, margin.seq}] = replay::whole_milliseconds(margin.microseconds);
    replay::append_step(line_, record_, margins);
  });
  assert(line_.ends_with('\n'));
  return line_;
}

const SharedStep& LiveStep::shared() const {
  if (!shared_)
    shared_ = std::make_shared<const RecordedStep>(record_, std::vector(margins_.begin(), margins_.end()));
  return shared_;
}

}  // namespace woodlouse::server
