#!/bin/sh
# clicks.mjs where Node is installed; status 77 where it is not.
command -v node > /dev/null || { echo "no Node is installed"; exit 77; }
exec node "$(dirname "$0")/clicks.mjs" "$@"
