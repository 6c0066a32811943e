# Sourced by the *_table.sh: serve BIN OPTIONS... starts a server of volcano on a free port; $server is its process,
# $address where it listens, $said the file with what it prints. It ends with the script.
server=
said=$(mktemp)
trap '[[ -z $server ]] || kill "$server" 2>/dev/null || true; rm -f "$said"' EXIT

serve() {
  "$1/woodlouse-server" --map maps/volcano.json --listen 127.0.0.1:0 "${@:2}" > "$said" 2> /dev/null &
  server=$!
  for _ in $(seq 100); do
    address=$(sed -n 's/^listening //p' "$said")
    [[ -z $address ]] || return 0
    sleep 0.1
  done
  echo "the server did not listen" >&2
  exit 1
}
