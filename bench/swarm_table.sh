#!/usr/bin/env bash
# bench/swarm_table.sh BIN BOTS SECONDS: the load tool against a server on the same machine; what both said.
set -euo pipefail
programs=$1 bots=$2 seconds=$3
source "$(dirname "$0")/serve_for_table.sh"
serve "$programs" --ticks $((60 * (seconds + 6)))
"$programs/woodlouse-swarm" --bots "$bots" --seconds "$seconds" "$address"
wait "$server"
server=
printf '\n# the server'"'"'s summary\n'
sed -n '2,$p' "$said"
