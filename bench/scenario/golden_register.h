// `goldens.txt` beside scenario files: what each of them played, by which behavior, and what came out. It
// holds golden hashes to match::kBehavior: the same script and the same behavior have the same hashes for
// ever.
//
//     # behavior scenario script hashes
//     1 walls 0123456789abcdef fedcba9876543210
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bench/scenario/scenario.h"
#include "shared/core/error.h"

namespace woodlouse::scenario {

inline constexpr const char* kRegisterName = "goldens.txt";

class GoldenRegister {
 public:
  struct Entry {
    int behavior = 0;
    std::uint64_t script = 0;  ///< script_digest()
    std::uint64_t hashes = 0;  ///< golden_digest()
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  /// Errors: where = "file:line".
  static core::Expected<GoldenRegister> read(const std::filesystem::path& file);

  /// What must not become of the scenario: the entry's script and `behavior`, but other hashes. Nothing: it
  /// may.
  [[nodiscard]] std::optional<core::Error> forbids(const Scenario& scenario, int behavior,
                                                   std::uint64_t hashes) const;
  /// What is wrong with a scenario's hashes as its file has them; REQUIRES all of them to be known.
  [[nodiscard]] std::optional<core::Error> check(const Scenario& scenario) const;

  void set(const std::string& name, const Entry& entry) { entries_[name] = entry; }
  /// Forgets scenarios whose files are gone.
  void drop_missing(const std::filesystem::path& folder);
  [[nodiscard]] std::string text() const;

 private:
  std::map<std::string, Entry> entries_;
};

}  // namespace woodlouse::scenario
