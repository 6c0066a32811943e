// A value that is made once, then shared unchanged on any thread; and the memory of such values used again.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace woodlouse::server {

/// A std::shared_ptr<const T>, but that a SharedPool sees when nobody else holds it any more.
template <typename T>
class SharedValue {
 public:
  /// None: false.
  SharedValue() = default;
  explicit SharedValue(T value) : block_(new Block{std::move(value)}) {}
  SharedValue(const SharedValue& other) noexcept : block_(other.block_) {
    if (block_ != nullptr) block_->holders.fetch_add(1, std::memory_order_relaxed);
  }
  SharedValue(SharedValue&& other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  SharedValue& operator=(SharedValue other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  ~SharedValue() {
    if (block_ != nullptr && block_->holders.fetch_sub(1, std::memory_order_acq_rel) == 1) delete block_;
  }

  [[nodiscard]] const T& operator*() const { return block_->value; }
  [[nodiscard]] const T* operator->() const { return &block_->value; }
  explicit operator bool() const { return block_ != nullptr; }
  void reset() { *this = SharedValue(); }
  /// The same one, not only an equal one.
  friend bool operator==(const SharedValue&, const SharedValue&) = default;

 private:
  template <typename>
  friend class SharedPool;
  struct Block {
    T value;
    std::atomic<std::size_t> holders{1};
  };
  Block* block_ = nullptr;
};

/// Makes values in the memory of those that nobody holds any more. One owner; its values go to any thread.
template <typename T>
class SharedPool {
 public:
  /// Of whose memory it keeps; while all of them are out, a value has memory of its own.
  static constexpr std::size_t kMost = 8;

  /// fill(T&) makes a value, of a new or a used one; is_kept(const T&) whether its memory is worth keeping.
  template <typename Fill, typename IsKept>
  SharedValue<T> make(const Fill& fill, const IsKept& is_kept) {
    for (SharedValue<T>& kept : kept_) {
      // What the others did with it comes before what is done now.
      if (kept.block_->holders.load(std::memory_order_acquire) != 1) continue;
      fill(kept.block_->value);
      if (is_kept(*kept)) return kept;
      SharedValue<T> grown = std::move(kept);
      kept = std::move(kept_.back());
      kept_.pop_back();
      return grown;
    }
    SharedValue<T> made{T()};
    fill(made.block_->value);
    if (kept_.size() < kMost && is_kept(*made)) kept_.push_back(made);
    return made;
  }

 private:
  std::vector<SharedValue<T>> kept_;
};

}  // namespace woodlouse::server
