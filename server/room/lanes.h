// The strands on which connections and broadcasts run. A session lives on one of them for good, and a room
// hands out to all its members of one lane in one go: no hop for each.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/strand.hpp>

#include <cassert>
#include <cstddef>
#include <vector>

namespace woodlouse::server {

using Lane = boost::asio::strand<boost::asio::io_context::executor_type>;

/// Never changes. io outlives it.
class Lanes {
 public:
  Lanes(boost::asio::io_context& io, std::size_t count) : io_(io) {
    assert(count >= 1);
    for (std::size_t k = 0; k < count; ++k) lanes_.push_back(boost::asio::make_strand(io));
  }

  [[nodiscard]] std::size_t size() const { return lanes_.size(); }
  [[nodiscard]] const Lane& operator[](std::size_t index) const { return lanes_[index]; }
  /// What they run on, for other strands.
  [[nodiscard]] boost::asio::io_context& io() const { return io_; }

 private:
  boost::asio::io_context& io_;
  std::vector<Lane> lanes_;
};

}  // namespace woodlouse::server
