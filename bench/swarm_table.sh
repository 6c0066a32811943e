#!/usr/bin/env bash
# bench/swarm_table.sh BIN BOTS SECONDS: the load tool against a server on the same machine; what both said.
set -euo pipefail
programs=$1 bots=$2 seconds=$3
said=$(mktemp)
server=
trap '[[ -z $server ]] || kill "$server" 2>/dev/null || true; rm -f "$said"' EXIT
ticks=$((60 * (seconds + 6)))
"$programs/woodlouse-server" --map maps/volcano.json --listen 127.0.0.1:0 --ticks "$ticks" > "$said" 2>/dev/null &
server=$!
for _ in $(seq 100); do
  address=$(sed -n 's/^listening //p' "$said")
  [[ -z $address ]] || break
  sleep 0.1
done
[[ -n $address ]] || { echo "the server did not listen" >&2; exit 1; }
"$programs/woodlouse-swarm" --bots "$bots" --seconds "$seconds" "$address"
wait "$server"
server=
printf '\n# the server'"'"'s summary\n'
sed -n '2,$p' "$said"
