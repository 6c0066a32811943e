#include "server/record_options.h"

#include <CLI/CLI.hpp>

#include <utility>

#include "server/option_checks.h"

namespace woodlouse::server {

void add_record_options(CLI::App& app, TypedRecord& typed) {
  app.add_option(
         "--record", typed.record,
         "Write recordings: a file, or a folder for {room}-%Y%m%dT%H%M%SZ.ndjson.zst in it. {room} and "
         "strftime's %Y %m %d %H %M %S %j %y %F %G %V %u (UTC) may stand in the name; with several "
         "rooms each has a file. Packed, unless it ends in .ndjson. One that is there is never "
         "written over: the next is numbered")
      ->envname("WOODLOUSE_RECORD");
  app.add_option("--record-every", typed.every,
                 "Begin a new file after this time, to the nearest 5 s: digits and s, m, h or d, at least "
                 "10s. SIGUSR1 does so, too")
      ->envname("WOODLOUSE_RECORD_EVERY");
  app.add_option("--record-keep", typed.keep,
                 "Bytes for all recordings that --record can have named; the oldest finished ones are "
                 "removed. Digits, and K, M, G or T for powers of 1024")
      ->envname("WOODLOUSE_RECORD_KEEP");
}

core::Expected<std::optional<RecordSettings>> checked_record(const TypedRecord& typed, std::size_t rooms) {
  if (!typed.record) {
    if (!typed.every && !typed.keep) return std::nullopt;
    return core::fail(typed.every ? "--record-every" : "--record-keep", "nothing is recorded",
                      "say where:  --record recordings/");
  }
  auto pattern = RecordPattern::parse(*typed.record, rooms);
  if (!pattern) return tl::unexpected(pattern.error());
  RecordSettings settings{std::move(*pattern)};
  if (typed.every) {
    const auto every = parse_duration("--record-every", *typed.every, kLeastRecordEvery);
    if (!every) return tl::unexpected(every.error());
    settings.every = *every;
  }
  if (typed.keep) {
    const auto keep = parse_bytes("--record-keep", *typed.keep);
    if (!keep) return tl::unexpected(keep.error());
    settings.keep_bytes = *keep;
  }
  return settings;
}

}  // namespace woodlouse::server
