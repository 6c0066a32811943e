// Maps that several rooms have in common, each in memory once for as long as one of them has it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "shared/map/map_definition.h"
#include "shared/replay/source.h"

namespace woodlouse::server {

/// Any thread.
class MapShelf final : public replay::Maps {
 public:
  [[nodiscard]] core::Expected<replay::MapPointer> find_or(
      std::string_view definition, const std::function<core::Expected<replay::MapPointer>()>& make) override;
  /// Maps that somebody has.
  [[nodiscard]] std::size_t size() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const map::Map>, std::less<>> maps_;  ///< by definition
};

}  // namespace woodlouse::server
