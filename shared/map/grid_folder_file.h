// A folder on the disk, for a map's grid file.
#pragma once

#include <filesystem>

#include "shared/map/grid_folder.h"

namespace woodlouse::map {

/// Any thread. What it opens lies in the folder, wherever links lead (core/input_file.h).
class DiskFolder final : public GridFolder {
 public:
  /// REQUIRES a folder that is named: "." for the present one.
  explicit DiskFolder(std::filesystem::path folder);

  [[nodiscard]] core::Expected<std::string> find(std::string_view name) const override;
  [[nodiscard]] core::Expected<std::string> read_text(const std::string& path) const override;
  [[nodiscard]] core::Expected<std::shared_ptr<const terrain::HeightSource>> open_heights(
      const std::string& path, std::optional<core::Vec2> corner) const override;

 private:
  std::filesystem::path folder_;
};

}  // namespace woodlouse::map
