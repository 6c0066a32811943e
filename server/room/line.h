// One encoded line, newline included: written once, then shared unchanged by all who send it, on any thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace woodlouse::server {

/// A std::shared_ptr<const std::string>, but that a LinePool sees when nobody else holds it any more.
class Line {
 public:
  /// None: false.
  Line() = default;
  explicit Line(std::string text) : block_(new Block{std::move(text)}) {}
  Line(const Line& other) noexcept : block_(other.block_) {
    if (block_ != nullptr) block_->holders.fetch_add(1, std::memory_order_relaxed);
  }
  Line(Line&& other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  Line& operator=(Line other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  ~Line() {
    if (block_ != nullptr && block_->holders.fetch_sub(1, std::memory_order_acq_rel) == 1) delete block_;
  }

  [[nodiscard]] const std::string& operator*() const { return block_->text; }
  [[nodiscard]] const std::string* operator->() const { return &block_->text; }
  explicit operator bool() const { return block_ != nullptr; }
  void reset() { *this = Line(); }
  /// The same line, not only an equal one.
  friend bool operator==(const Line&, const Line&) = default;

 private:
  friend class LinePool;
  struct Block {
    std::string text;
    std::atomic<std::size_t> holders{1};
  };
  Block* block_ = nullptr;
};

/// Writes lines into the memory of those that nobody holds any more. One owner; its lines go to any thread.
class LinePool {
 public:
  /// Of whose memory it keeps; while all of them are out, a line has memory of its own.
  static constexpr std::size_t kMost = 8;

  /// write(std::string&) appends the text.
  template <typename Write>
  Line line(const Write& write) {
    for (const Line& kept : kept_) {
      // What the others did with it comes before what is done now.
      if (kept.block_->holders.load(std::memory_order_acquire) != 1) continue;
      kept.block_->text.clear();
      write(kept.block_->text);
      return kept;
    }
    Line made{std::string()};
    write(made.block_->text);
    if (kept_.size() < kMost) kept_.push_back(made);
    return made;
  }

 private:
  std::vector<Line> kept_;
};

}  // namespace woodlouse::server
