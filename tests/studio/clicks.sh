#!/bin/sh
# A script of clicks where Node is installed; status 77 where it is not. usage: clicks.sh SCRIPT WHIRL CASE
command -v node > /dev/null || { echo "no Node is installed"; exit 77; }
script=$1
shift
exec node "$(dirname "$0")/$script" "$@"
