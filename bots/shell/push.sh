#!/bin/sh
# Joins, pushes north for half a second, prints what comes for SECONDS, leaves: push.sh [HOST [PORT [SECONDS]]]
# Needs nc (netcat-openbsd or traditional). Every line printed is a message of docs/protocol.md.
host=${1:-127.0.0.1} port=${2:-7777} seconds=${3:-3}
{
  echo '{"type":"join","protocol":1,"role":"bot","name":"push.sh","fields":["x","y","z","speed"],"state_hz":2}'
  sleep 0.3
  echo '{"type":"input","seq":1,"thrust":[0,1],"ticks":30}'
  sleep "$seconds"
  echo '{"type":"leave"}'
  sleep 0.3
} | nc "$host" "$port"
