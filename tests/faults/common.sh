# What the fault tests share. After: program, root (of the project), work (an empty folder, removed in the end).
set -euo pipefail

broken=0
complain() { echo "BROKEN: $*"; broken=$((broken + 1)); }

# What a report is without the times of the run.
timeless() {
  sed -E 's/"(seconds|date)": ?("[^"]*"|[0-9.e+-]+)//g; s/[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]+Z//g; s/computed in [^<]*//' "$1"
}

# same_results FOLDER REFERENCE: the same names with the same content, each picture to the last byte.
same_results() {
  local name
  [[ "$(ls -A "$1")" == "$(ls -A "$2")" ]] || { echo "names: $(ls -A "$1" | tr '\n' ' ')"; return 1; }
  for name in "$2"/*; do
    name="${name##*/}"
    case "$name" in
      *.json | *.html) cmp -s <(timeless "$1/$name") <(timeless "$2/$name") || { echo "$name"; return 1; } ;;
      *) cmp -s "$1/$name" "$2/$name" || { echo "$name"; return 1; } ;;
    esac
  done
}

# put_old_results FOLDER REFERENCE: files of these names as an earlier run would have left them, and one that is not a result.
put_old_results() {
  local name
  mkdir -p "$1"
  for name in "$2"/*; do echo "old ${name##*/}" > "$1/${name##*/}"; done
  echo mine > "$1/notes.txt"
}

# old_results FOLDER REFERENCE: they are all there still, and nothing else.
old_results() {
  local name
  for name in "$2"/*; do
    [[ "$(cat "$1/${name##*/}" 2> /dev/null)" == "old ${name##*/}" ]] || { echo "${name##*/}"; return 1; }
  done
  [[ "$(ls -A "$1" | wc -l)" == "$(($(ls -A "$2" | wc -l) + 1))" ]] || { echo "names: $(ls -A "$1" | tr '\n' ' ')"; return 1; }
}

finish() { # WHAT
  echo "$1, $broken broken"
  exit $((broken > 0))
}
