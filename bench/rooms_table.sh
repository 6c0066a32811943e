#!/usr/bin/env bash
# bench/rooms_table.sh BIN [FORMER_BIN]: what 250 rooms (a server opens 256 maps at most) take of a core, eight of the
# house's bots in each, and nobody in any; of a former tree's server in turns, where there is one. Medians of three.
set -euo pipefail
cd "$(dirname "$0")/.."
readonly kRooms=250 kSettle=14 kSeconds=10
maps=()
for ((room = 0; room < kRooms; ++room)); do maps+=(--map maps/volcano.json); done

# What a server of bin $1 takes of a core [%] with options $2..., and its memory [MB].
take() {
  local bin=$1 log
  shift
  log=$(mktemp)
  "$bin/woodlouse-server" "${maps[@]}" --listen 127.0.0.1:0 "$@" > "$log" 2>&1 &
  server=$!
  sleep "$kSettle"
  local before after memory
  before=$(awk '{print $14 + $15}' "/proc/$server/stat")
  sleep "$kSeconds"
  after=$(awk '{print $14 + $15}' "/proc/$server/stat")
  memory=$(awk '/VmRSS/ {print $2}' "/proc/$server/status")
  kill "$server"
  wait "$server" || true
  rm "$log"
  awk -v ticks="$((after - before))" -v hz="$(getconf CLK_TCK)" -v seconds="$kSeconds" -v kb="$memory" \
    'BEGIN {printf "%.2f %.0f\n", 100 * ticks / hz / seconds, kb / 1024}'
}

median() { sort -g | sed -n 2p; }

printf '%-44s %10s %8s\n' "$kRooms rooms of volcano, 60 Hz" 'core [%]' 'MB'
for scene in "8:--bots-alone play" "0:"; do
  bots=${scene%%:*}
  read -ra options <<< "--bots $bots ${scene#*:}"
  declare -A rows=()
  for round in 1 2 3; do
    for bin in "$@"; do
      # A tree from before rooms slept knows no such option: its rooms never do.
      known=("${options[@]}")
      "$bin/woodlouse-server" --help | grep -q bots-alone || known=(--bots "$bots")
      rows[$bin]+=$(take "$bin" "${known[@]}")$'\n'
    done
  done
  for bin in "$@"; do
    which=$([[ $bin == "$1" ]] && echo 'this tree' || echo 'former tree')
    printf '%-44s %10s %8s\n' "$bots bots in each, $which" "$(cut -d' ' -f1 <<< "${rows[$bin]%$'\n'}" | median)" \
      "$(cut -d' ' -f2 <<< "${rows[$bin]%$'\n'}" | median)"
  done
done
