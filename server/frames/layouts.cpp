#include "server/frames/layouts.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace woodlouse::server {
namespace {

const std::vector<protocol::Column>& every_column() {
  static const std::vector<protocol::Column> columns = [] {
    std::vector<protocol::Column> every;
    for (std::size_t k = 0; k < protocol::kColumnCount; ++k)
      every.push_back(static_cast<protocol::Column>(k));
    return every;
  }();
  return columns;
}

/// Common ones: the default, a louse's own fields, and all that there is.
bool is_rare(const RowLayout& layout) {
  return layout.fields != protocol::default_columns() && layout.fields != protocol::all_columns() &&
         layout.fields != every_column();
}

bool has_all(const RowLayout& layout, const std::vector<protocol::Column>& fields) {
  return std::all_of(fields.begin(), fields.end(), [&](protocol::Column field) {
    return std::find(layout.fields.begin(), layout.fields.end(), field) != layout.fields.end();
  });
}

}  // namespace

RowLayout Layouts::wider(const RowLayout& layout) const {
  RowLayout best{protocol::all_columns(), layout.format, layout.in_sheets};
  if (!has_all(best, layout.fields)) best.fields = every_column();
  for (const auto& [id, use] : uses_) {
    const RowLayout& own = use.layout;
    if (own.format == layout.format && own.in_sheets == layout.in_sheets &&
        own.fields.size() < best.fields.size() && has_all(own, layout.fields))
      best = own;
  }
  return best;
}

Layouts::Acquired Layouts::acquire(const RowLayout& layout, AddressId address, std::size_t per_address) {
  const auto same = [&layout](const auto& entry) { return entry.second.layout == layout; };
  auto found = std::find_if(uses_.begin(), uses_.end(), same);
  const bool is_new = found == uses_.end();
  if (is_new) {
    if (is_rare(layout)) {
      const auto own = rare_of_.find(address);
      if (rare_ >= kMostRare || (own == rare_of_.end() ? 0 : own->second) >= per_address)
        return acquire(wider(layout), address, per_address);
      ++rare_;
      ++rare_of_[address];
    }
    found = uses_.emplace(next_id_++, Use{layout, address, 0}).first;
  }
  ++found->second.clients;
  return {found->first, is_new};
}

bool Layouts::release(ChannelId channel) {
  const auto found = uses_.find(channel);
  assert(found != uses_.end() && found->second.clients > 0);
  if (--found->second.clients > 0) return false;
  if (is_rare(found->second.layout)) {
    --rare_;
    const auto own = rare_of_.find(found->second.first_asked);
    assert(own != rare_of_.end());
    if (--own->second == 0) rare_of_.erase(own);
  }
  uses_.erase(found);
  return true;
}

}  // namespace woodlouse::server
