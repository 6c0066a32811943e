// A progress bar on standard error, and only where that is a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace woodlouse::lab {

class Progress {
 public:
  /// total: steps until done, > 0.
  Progress(std::string what, std::size_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Wipes the bar.
  ~Progress();
  void advance(std::size_t steps = 1);

 private:
  std::string what_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::size_t shown_ = 0;  ///< per mille on the screen
  bool on_terminal_;
};

}  // namespace woodlouse::lab
