#!/usr/bin/env bash
# The manual pages in docs/man/ are what the program prints with --man, and mandoc, where it is
# installed, finds no error in them.
# Usage: check_manual.sh PROGRAM [project root] [write]. With write: makes them anew.
set -euo pipefail
program="$1"
cd "${2:-$(dirname "${BASH_SOURCE[0]}")/..}"
folder=docs/man

page_of() { # COMMAND, or nothing for the program's own
  "$program" "$@" --man
}

mapfile -t commands < <(page_of | sed -n 's/^\.BR whirl\\-\([a-z\\-]*\) (1)$/\1/p' | tr -d '\\')
((${#commands[@]} > 10)) || { echo "whirl --man lists no commands"; exit 1; }

if [[ "${3-}" == write ]]; then
  mkdir -p "$folder"
  rm -f "$folder"/*.1
  page_of > "$folder/whirl.1"
  for command in "${commands[@]}"; do page_of "$command" > "$folder/whirl-$command.1"; done
fi

broken=0
complain() { echo "$*"; broken=1; }

check() { # FILE COMMAND...
  local file="$folder/$1"
  [[ -e "$file" ]] || { complain "$file is missing: ./run man"; return; }
  cmp -s "$file" <(page_of "${@:2}") || complain "$file is not what the program prints: ./run man"
  if command -v mandoc > /dev/null; then
    mandoc -T lint -W error "$file" || complain "$file: mandoc finds an error"
  fi
}
check whirl.1
for command in "${commands[@]}"; do check "whirl-$command.1" "$command"; done
for file in "$folder"/*.1; do
  name="$(basename "$file" .1)"
  [[ "$name" == whirl || " ${commands[*]} " == *" ${name#whirl-} "* ]] || complain "$file: no such command"
done
exit "$broken"
