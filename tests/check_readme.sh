#!/usr/bin/env bash
# What README.md and docs/ say must exist: cases in command blocks, folders of the map, links,
# pictures; and every case must be listed in docs/verification.md.
# Usage: check_readme.sh [project root]. Prints every break of a rule; exit status 1 if any.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

broken=0
complain() { echo "$*"; broken=1; }

pages=(README.md docs/*.md cases/*/README.md)

# Cases in the command blocks of a page: words below cases/ that follow ./run or whirl.
for page in "${pages[@]}"; do
  while read -r path; do
    [[ -e "$path" ]] || complain "$page: a command block names $path, which does not exist"
  done < <(awk '/^```/ {inside = !inside; next} inside && /(\.\/run|whirl) /' "$page" |
    grep -oE '(^| )cases/[A-Za-z0-9_./-]+' | tr -d ' ' | sort -u)
  while read -r link; do
    [[ -e "$(dirname "$page")/${link%%#*}" ]] || complain "$page: link to $link, which does not exist"
  done < <(grep -oE '\]\([^)# ]+(#[^) ]*)?\)' "$page" | sed -E 's/^\]\(//; s/\)$//' |
    grep -vE '^(https?|mailto):' || true)
done

# The map of folders: lines "| `folder/` | ..." of README.md.
map="$(grep -oE '^\| `[^`]+`' README.md | sed -E 's/^\| `//; s/`$//')"
while read -r entry; do
  [[ -e "$entry" ]] || complain "README.md: the map names $entry, which does not exist"
done < <(grep -E '/' <<< "$map")
for folder in src/*/ cases/ meshes/ tests/ docs/; do
  grep -qx "$folder" <<< "$map" || complain "README.md: the map does not name $folder"
done

for folder in cases/*/; do
  grep -qF "cases/$(basename "$folder")" docs/verification.md ||
    complain "docs/verification.md does not list $folder"
done

exit "$broken"
