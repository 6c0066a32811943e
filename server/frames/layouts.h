// Which row layouts a room's clients have, and who may have one more. Encoding them is Channels' work.
// Pure. The room's strand owns it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "server/frames/row_table.h"

namespace woodlouse::server {

/// A layout in use in a room; never used again for another one.
using ChannelId = std::uint32_t;
/// No layout's: of who watches by inputs and is shown no frames.
inline constexpr ChannelId kByInputs = 0;
/// Counts the addresses of clients; an address keeps its number while anybody is connected from there.
using AddressId = std::uint64_t;

class Layouts {
 public:
  /// In a room at a time, besides the common ones, which everybody can have; bounds the encoding of a tick.
  static constexpr std::size_t kMostRare = 32;

  struct Acquired {
    ChannelId channel = 0;
    bool is_new = false;  ///< nobody had it before
  };
  /// One more client of that layout, from that address. Where there are kMostRare others, or `per_address`
  /// that this address was the first to ask for: of the smallest one in use that has its columns, or of every
  /// column.
  Acquired acquire(const RowLayout& layout, AddressId address, std::size_t per_address);
  /// One client less; true: it was the last one.
  bool release(ChannelId channel);

  /// REQUIRES an acquired channel.
  [[nodiscard]] const RowLayout& layout(ChannelId channel) const { return uses_.at(channel).layout; }
  [[nodiscard]] bool empty() const { return uses_.empty(); }

 private:
  struct Use {
    RowLayout layout;
    AddressId first_asked = 0;
    std::size_t clients = 0;
  };
  [[nodiscard]] RowLayout wider(const RowLayout& layout) const;

  std::map<ChannelId, Use> uses_;
  std::map<AddressId, std::size_t> rare_of_;  ///< how many rare ones each was the first to ask for
  std::size_t rare_ = 0;
  ChannelId next_id_ = 1;
};

}  // namespace woodlouse::server
