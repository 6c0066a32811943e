// Energy from nothing, by contact, method and force: lice on grounds of three roughnesses between elastic
// walls, at 15, 60 and 240 ticks a second, by the server's own steps; the highest a louse ever stood above
// the lowest it had come to (where nothing takes energy: above its start), of its energy above the map's
// lowest place. Where a thrust gives some, above that and what the thrust has given: its power along the way,
// in shorter steps of the same way; or all that it can give along that way, where shorter steps lead
// elsewhere ("unforeseen": the share of ticks).
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// 20 lice and 100 s a cell (quick: 7 and 5 s).
Table gains(Effort effort);

}  // namespace woodlouse::lab
