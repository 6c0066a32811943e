// What the page holds on to: numbers from 1, each for one object until it is closed. One that is none is a
// fault of the page's own, and ends the instance.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace woodlouse::web {

using Handle = std::uint32_t;

template <typename Object>
class Handles {
 public:
  Handle add(std::unique_ptr<Object> object) {
    assert(object != nullptr);
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      if (objects_[k] != nullptr) continue;
      objects_[k] = std::move(object);
      return static_cast<Handle>(k + 1);
    }
    objects_.push_back(std::move(object));
    return static_cast<Handle>(objects_.size());
  }
  /// REQUIRES an open one.
  Object& at(Handle handle) {
    assert(handle >= 1 && handle <= objects_.size() && objects_[handle - 1] != nullptr);
    return *objects_[handle - 1];
  }
  /// REQUIRES an open one.
  void close(Handle handle) {
    assert(handle >= 1 && handle <= objects_.size() && objects_[handle - 1] != nullptr);
    objects_[handle - 1].reset();
  }

 private:
  std::vector<std::unique_ptr<Object>> objects_;
};

}  // namespace woodlouse::web
