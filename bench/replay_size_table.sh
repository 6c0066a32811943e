#!/usr/bin/env bash
# bench/replay_size_table.sh BIN FOLDER: records 100 bots that push ten times a second, and tells what the parts take.
set -euo pipefail
programs=$1 recording=$2/game.ndjson.zst
source "$(dirname "$0")/serve_for_table.sh"
serve "$programs" --seed 1 --record "$recording"
"$programs/woodlouse-swarm" "$address" --bots 100 --seconds 40 --inputs-per-second 10 > /dev/null
kill "$server"
wait "$server" || true
server=
cat <<TEXT
What a recording of 100 bots takes: 100 x 10 random pushes a second (two thirds pairs, a third numbers, half of them
pulses of 1 to 60 ticks), 60 ticks/s, margins as measured.

TEXT
python3 bench/replay_size.py "$recording"
