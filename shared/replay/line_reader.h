// A recording's lines, read back and checked.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>

#include "shared/core/error.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/format.h"
#include "shared/replay/line_order.h"

namespace woodlouse::replay {

/// Reads a recording line by line; memory is bounded by one line. Every field is checked here, and which line
/// may follow which (line_order.h): what passes is in range and in its place, so that a re-run may trust it
/// (but not that a state fits its map, or a step the one before: that is whoever's re-runs it).
class ReplayReader {
 public:
  /// `in` outlives the reader; `source` names it in errors ("FILE:LINE: field: what"). `line`: how many lines
  /// stand before where `in` is. `longest_line`: fewer bytes than kMaxReplayLineBytes for who has less
  /// memory.
  ReplayReader(InputStream& in, std::string source, std::size_t line = 0,
               std::size_t longest_line = kMaxReplayLineBytes)
      : in_(in), source_(std::move(source)), line_number_(line), longest_line_(longest_line) {}

  /// The first line. Refuses another format, version or behavior, naming both.
  core::Expected<Header> read_header();
  /// The next line; nothing at the end of the file, or after a last line that was cut off. A line that stands
  /// for many steps is given as often, a step at a time.
  core::Expected<std::optional<Line>> next();
  /// The same, but such a line is given once, for who does not re-run them: a short file can stand for more
  /// steps than anybody wants to wait for. REQUIRES that next() has given all steps of the line before.
  core::Expected<std::optional<Line>> next_line();

  /// How many steps of a line that stands for many next() has still to give: all of them did nothing.
  [[nodiscard]] std::uint64_t quiet_steps() const { return quiet_.steps; }
  /// Passes over so many of them. REQUIRES count <= quiet_steps().
  void skip_quiet(std::uint64_t count) {
    assert(count <= quiet_.steps);
    quiet_.step.tick += count;
    quiet_.steps -= count;
  }

  /// The file's last line has no newline, or its last zstd frame no end: whoever wrote it was interrupted.
  /// Known once next() gave nothing.
  [[nodiscard]] bool is_cut_off() const { return cut_off_; }
  /// next() failed at a line that a reader of longer lines may take.
  [[nodiscard]] bool wants_longer_lines() const { return wants_longer_lines_; }
  /// That line, without its newline.
  [[nodiscard]] const std::string& line() const { return line_; }
  /// The line read last, from 1.
  [[nodiscard]] std::size_t line_number() const { return line_number_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  /// The bytes this reader took before that line.
  [[nodiscard]] std::uint64_t line_offset() const { return line_offset_; }
  /// "FILE:LINE", of the line read last.
  [[nodiscard]] std::string place() const;

 private:
  core::Expected<bool> read_line();  ///< false: no further whole line
  core::Expected<bool> read_into(Line& line);

  InputStream& in_;
  std::string source_;
  std::string line_;
  std::size_t line_number_ = 0;
  std::uint64_t line_offset_ = 0;
  std::size_t longest_line_;
  bool cut_off_ = false;
  bool wants_longer_lines_ = false;
  LineOrder order_;
  StepLine quiet_{
      {}, {}, 0};  ///< what is still to come of the line read last, where it stands for many steps
};

}  // namespace woodlouse::replay
