#include "server/stream/map_shelf.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::server {

core::Expected<replay::MapPointer> MapShelf::find_or(
    std::string_view definition, const std::function<core::Expected<replay::MapPointer>()>& make) {
  assert(!definition.empty() && make);
  {
    const std::lock_guard lock(mutex_);
    const auto known = maps_.find(definition);
    if (known != maps_.end())
      if (auto map = known->second.lock()) return map;
  }
  auto made = make();  // of two threads that make the same each has its own
  if (!made) return made;
  assert(*made != nullptr);
  const std::lock_guard lock(mutex_);
  std::erase_if(maps_, [](const auto& one) { return one.second.expired(); });
  maps_.insert_or_assign(std::string(definition), *made);
  return made;
}

std::size_t MapShelf::size() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::count_if(maps_.begin(), maps_.end(), [](const auto& one) { return !one.second.expired(); }));
}

}  // namespace woodlouse::server
