#!/usr/bin/env bash
# bench/replay_size_table.sh BIN FOLDER: records 100 bots that push ten times a second, and tells what the parts take.
set -euo pipefail
programs=$1 folder=$2
said=$folder/said.txt
recording=$folder/game.ndjson.zst
server=
trap '[[ -z $server ]] || kill "$server" 2>/dev/null || true' EXIT
"$programs/woodlouse-server" --map maps/volcano.json --listen 127.0.0.1:0 --seed 1 --record "$recording" > "$said" 2>/dev/null &
server=$!
for _ in $(seq 100); do
  address=$(sed -n 's/^listening //p' "$said")
  [[ -z $address ]] || break
  sleep 0.1
done
[[ -n $address ]] || { echo "the server did not listen" >&2; exit 1; }
"$programs/woodlouse-swarm" "$address" --bots 100 --seconds 40 --inputs-per-second 10 > /dev/null
kill "$server"
wait "$server" || true
server=
cat <<TEXT
What a recording of 100 bots takes: 100 x 10 random pushes a second (two thirds pairs, a third numbers, half of them
pulses of 1 to 60 ticks), 60 ticks/s, margins as measured.

TEXT
python3 bench/replay_size.py "$recording"
