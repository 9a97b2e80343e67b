#!/usr/bin/env bash
# The include arrows between the folders of src/.
# Usage: check_includes.sh [project root]. Prints every break of a rule; exit status 1 if any.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

# The rooms of src/ from the ground up. A room includes from itself and from those before it, and
# from no other: so every arrow points down.
rooms=(model results mesh elements balancers linalg balancing process assembly reduction rigid periodic modes mesh_error
  tracking synchronous forced stability ends criterion simulation states operation analyses)
# What stands on all of them knows only what it needs.
declare -A allowed=(
  [main]="analyses cli eigen input model process report"
  [cli]="analyses input linalg model process report results"
  [report]="balancers model process results"
  [input]="balancers model"
  [closed_form]=""
  [eigen]="" # comes with the precompiled header, not by name
)
for ((i = 0; i < ${#rooms[@]}; ++i)); do
  allowed["${rooms[i]}"]="${rooms[*]:0:i}"
done
allowed[balancing]="linalg"
allowed[linalg]="model"     # errors alone, see below
allowed[process]="linalg model"
allowed[elements]="mesh model"
allowed[mesh]="model"
allowed[results]="model"
allowed[balancers]="model"
# Rooms that compare with the closed forms, or use the families of balanced positions in them.
sees_closed_form="balancers rigid criterion analyses"

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
    [[ "$target" == closed_form && " $sees_closed_form " == *" $folder "* ]] ||
      complain "$where: $folder must not include \"$header\""
  }
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

exit "$broken"
