#!/usr/bin/env bash
# The tutorials in docs/: their commands run, and print what the pages say they print.
#   ```toml NAME, ```csv NAME    the block is added to the file NAME
#   ```console                   lines "$ whirl ..." are run; every other line, but for "...", must be
#                                a line of their output, in this order, whatever the blanks
# Numbers agree within 1e-5 of their size: rounding differs between computers, and the least that
# is printed is five digits. Decimals of fewer digits agree within one of their last digit. Those
# below 1e-5 are error estimates: they must be below 1e-5.
# Usage: check_tutorials.sh PROGRAM [project root] [page...]
set -euo pipefail
program="$(realpath "$1")"
root="$(realpath "${2:-$(dirname "${BASH_SOURCE[0]}")/..}")"
pages=("${@:3}")
((${#pages[@]})) || pages=("$root"/docs/tutorial_*.md)
mapfile -t pages < <(realpath -e "${pages[@]}") # the work is done in other folders
((${#pages[@]})) || { echo "no tutorials"; exit 1; }
whirl() { "$program" "$@"; }

broken=0
complain() { echo "$*"; broken=1; }

# found LINE FROM: prints the number of the first line of ./printed from FROM on that is like LINE.
found() {
  WANTED="$1" awk -v from="$2" '
    function number(text) { return text ~ /^[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?$/ }
    function size(x) { return x < 0 ? -x : x }
    # Of a decimal of up to three digits, else 0.
    function last_digit(text,   decimals, digits) {
      if (text !~ /^-?[0-9]+\.[0-9]+$/) return 0
      decimals = text; sub(/.*\./, "", decimals)
      digits = text; gsub(/[-.]/, "", digits); sub(/^0+/, "", digits)
      return length(digits) < 4 ? 10 ^ -length(decimals) : 0
    }
    function alike(a, b) {
      if (!number(a) || !number(b)) return a == b
      if (size(a) < 1e-5 && size(b) < 1e-5 && a != 0 && b != 0) return 1
      return size(a - b) <= 1e-5 * size(a) || size(a - b) <= last_digit(a)
    }
    BEGIN { words = split(ENVIRON["WANTED"], wanted) }
    NR >= from && NF == words {
      same = 1
      for (i = 1; i <= words; ++i) if (!alike(wanted[i], $i)) same = 0
      if (same) { print NR; exit }
    }' printed
}

for page in "${pages[@]}"; do
  folder="$(mktemp -d)"
  cd "$folder"
  ln -s "$root/cases" "$root/meshes" .
  kind="" file="" line=0 next=1
  : > printed
  while IFS= read -r text; do
    line=$((line + 1))
    where="docs/$(basename "$page"):$line"
    if [[ "$text" == '```'* ]]; then
      if [[ -n "$kind" ]]; then
        kind=""
      else
        read -r kind file <<< "${text#'```'} "
        [[ -n "$kind" ]] || kind=plain
      fi
    elif [[ ("$kind" == toml || "$kind" == csv) && -n "$file" ]]; then
      printf '%s\n' "$text" >> "$file"
    elif [[ "$kind" == console && "$text" == '$ '* ]]; then
      eval "${text#'$ '}" > printed 2>&1 < /dev/null || complain "$where: exit status $?: $(tail -n 3 printed)"
      next=1
    elif [[ "$kind" == console && -n "${text// /}" && "$text" != ... ]]; then
      at="$(found "$text" "$next")"
      [[ -n "$at" ]] && next=$((at + 1)) || complain "$where: not printed: $text"
    fi
  done < "$page"
  cd "$root"
  rm -rf "$folder"
done
exit "$broken"
