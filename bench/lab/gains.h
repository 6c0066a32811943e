// Energy from nothing, by contact, method and force: lice on grounds of three roughnesses between elastic
// walls, at 15, 60 and 240 ticks a second, by the server's own steps; the highest a louse ever stood above
// the lowest it had come to (where nothing takes energy: above its start), of its energy above the map's
// lowest place.
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// 100 s a cell (quick: 5 s).
Table gains(Effort effort);

}  // namespace woodlouse::lab
