#!/usr/bin/env bash
# The include arrows between the folders of src/, and the limits on file length.
# Usage: check_includes.sh [project root]. Prints every break of a rule; exit status 1 if any.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

# folder of src/: folders it may include from, besides itself.
declare -A allowed=(
  [main]="cli input analyses report model"
  [cli]="input analyses linalg report model"
  [report]="analyses model"
  [analyses]="reduction assembly linalg mesh elements model"
  [reduction]="assembly linalg elements mesh model"
  [assembly]="elements mesh linalg model"
  [elements]="mesh model"
  [mesh]="model"
  [linalg]="model"
  [input]="model"
  [model]=""
  [closed_form]=""
)
# Analyses whose purpose is the comparison with the rigid closed forms.
compares_with_closed_form='^(rigid_limit|balance|balanced_position|show|accuracy)'

broken=0
complain() { echo "$*"; broken=1; }

# check_line FOLDER FILE LINE_NUMBER HEADER: one #include.
check_line() {
  local folder="$1" file="$2" where="$2:$3" header="$4" target
  if [[ "$header" =~ ^\<(petsc|slepc) ]]; then
    [[ "$folder" == linalg || "$folder" == assembly ]] ||
      complain "$where: $header>: PETSc and SLEPc only in linalg and assembly"
    return
  fi
  [[ "$header" == \<* ]] && return
  header="${header//\"/}"
  if [[ "$header" != */* ]]; then # a private header of closed_form, whose include root is its own
    [[ "$folder" == closed_form && -e "$(dirname "$file")/$header" ]] ||
      complain "$where: \"$header\": write the path from src/"
    return
  fi
  target="${header%%/*}"
  [[ "$target" == "$folder" || " ${allowed[$folder]} " == *" $target "* ]] || {
    [[ "$folder" == analyses && "$target" == closed_form &&
      "$(basename "$file")" =~ $compares_with_closed_form ]] ||
      complain "$where: $folder must not include \"$header\""
  }
  [[ "$folder" != cli || "$target" != linalg || "$header" == linalg/session.h ]] ||
    complain "$where: cli knows of linalg only linalg/session.h"
  [[ "$folder" != linalg || "$target" != model || "$header" == model/errors.h ]] ||
    complain "$where: linalg knows of model only model/errors.h"
}

checked=0
while IFS=: read -r file number text; do
  folder="${file#src/}"
  [[ "$folder" == */* ]] && folder="${folder%%/*}" || folder=main
  [[ -v "allowed[$folder]" ]] || { complain "$file: folder $folder has no rule here"; continue; }
  [[ "$text" =~ \#[[:space:]]*include[[:space:]]*([\<\"][^\>\"]+) ]] || continue
  check_line "$folder" "$file" "$number" "${BASH_REMATCH[1]}"
  checked=$((checked + 1))
done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include' src --include='*.h' --include='*.cpp')
((checked)) || complain "no #include found below src: wrong folder?"

while read -r lines file; do
  case "$file" in
    *.h) ((lines <= 150)) || complain "$file: $lines lines, a header has at most 150" ;;
    *.cpp) ((lines <= 400)) || complain "$file: $lines lines, a source has at most 400" ;;
  esac
done < <(find src tests \( -name '*.h' -o -name '*.cpp' \) -exec wc -l {} +)

exit "$broken"
