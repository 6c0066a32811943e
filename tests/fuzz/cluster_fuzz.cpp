// What NATS brings: batches of a log, beats of hosts, an operator's orders. What passes is read to its end
// without harm, the rooms it tells of are re-run, and what does not says why on one line.
//
// Input: a letter, 'b' a batch's text (packed here), 'p' a batch as it comes, 't' a beat, 'o' an order to
// move; and that.
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

#include "server/cluster/batch.h"
#include "server/cluster/host_table.h"
#include "server/cluster/joined_log.h"
#include "server/cluster/shard_view.h"
#include "shared/replay/zstd_packer.h"
#include "tests/fuzz/property.h"

using namespace woodlouse;
using namespace woodlouse::server;
using woodlouse::fuzz::demand;
using woodlouse::fuzz::demand_readable;

namespace {

void read_batch(std::string_view packed) {
  const auto batch = unpack(packed, "batch 7");
  if (!batch) return demand_readable(batch.error().text().substr(0, fuzz::kMaxErrorBytes));
  demand(!batch->head.writer.host.empty(), "a writer has a name");
  demand(batch->head.rooms.size() <= kMostRoomsOfShard, "rooms are bounded");
  const auto again = unpack(pack(batch->head, batch->lines), "again");
  demand(again && again->head == batch->head && again->lines == batch->lines, "a batch comes back as it was");
  ShardView view;
  const auto taken = view.take(7, *batch);
  if (!taken) demand_readable(taken.error().text().substr(0, fuzz::kMaxErrorBytes));
  demand(view.rooms().size() <= kMostRoomsOfShard, "so are those that it tells of");
  std::ostringstream told;
  JoinedLog joined({}, told);
  if (taken) demand(joined.take(7, *batch).has_value(), "what a view reads can be joined");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'p') read_batch(text);
  if (data[0] == 'b') {
    replay::FramePacker packer;
    std::string packed;
    packer.append(packed, text);
    packer.end_frame(packed);
    read_batch(packed);
  }
  if (data[0] == 't') {
    const auto beat = beat_from(text);
    if (!beat)
      demand_readable(beat.error().text().substr(0, fuzz::kMaxErrorBytes));
    else
      demand(beat_from(to_text(*beat)) == *beat, "a beat comes back as it was");
  }
  if (data[0] == 'o') {
    const auto order = move_order_from(text);
    if (!order) {
      demand_readable(order.error().text().substr(0, fuzz::kMaxErrorBytes));
    } else {
      const auto again = move_order_from(to_text(*order));
      demand(again && again->from == order->from && again->to == order->to, "an order comes back as it was");
    }
  }
  return 0;
}
