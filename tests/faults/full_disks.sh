#!/usr/bin/env bash
# Runs on disks of many sizes that are too small, or just large enough: where the program says that it succeeded every
# file is whole; where it says that it failed nothing has been replaced and nothing is left behind.
# Usage: full_disks.sh PROGRAM ROOT [RUNS] [LIBRARY]. With the library (without_nameless_files.cpp) half of the runs are
# as on a file system that knows no files without names. Needs a mount namespace of its own: root, or user namespaces; else it is
# skipped with exit status 77.
program="$1" root="$2" runs="${3:-20}" library="${4-}"
if [[ -z "${WHIRL_MOUNTS-}" ]]; then
  as=(unshare --mount)
  "${as[@]}" true 2> /dev/null || as=(unshare --mount --map-root-user)
  "${as[@]}" true 2> /dev/null || { echo "skipped: no mount namespace may be made here"; exit 77; }
  WHIRL_MOUNTS=1 exec "${as[@]}" "${BASH_SOURCE[0]}" "$@"
fi
# shellcheck source=tests/faults/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
work="$(mktemp -d)"
trap 'umount -q "$work/disk" 2> /dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/disk"
mount -t tmpfs -o size=64k none "$work/disk" 2> /dev/null || { echo "skipped: nothing may be mounted here"; exit 77; }
umount "$work/disk"

# reference NAME ARGUMENT...: the files of a run with room, and how much it takes.
declare -A arguments kilobytes
commands=()
reference() {
  commands+=("$1")
  arguments[$1]="${*:2}"
  "$program" ${arguments[$1]} --quiet --out "$work/$1"
  kilobytes[$1]="$(du -k --apparent-size --summarize "$work/$1" | cut -f1)"
}
reference show show "$root/cases/composite_rotor"
reference critical critical "$root/cases/friswell_5_9_1"
reference response response "$root/cases/nelson_mcvaugh" --set speeds.count=21

succeeded=0 failed=0
for ((run = 0; run < runs; run++)); do
  name="${commands[run % ${#commands[@]}]}"
  # From a page to a quarter more than it takes.
  size=$((4 + (kilobytes[$name] * 5 / 4) * run / runs))
  mount -t tmpfs -o "size=${size}k" none "$work/disk"
  out="$work/disk/out" old=$((run / ${#commands[@]} % 2))
  if ((old)); then put_old_results "$out" "$work/$name" 2> /dev/null || old=0; fi
  ((old)) || rm -rf "$out"
  status=0
  preload=""
  ((run / (2 * ${#commands[@]}) % 2)) && preload="$library"
  LD_PRELOAD="$preload" "$program" ${arguments[$name]} --quiet --out "$out" 2> "$work/errors" || status=$?
  where="run $run, $name on $size kB"
  case "$status" in
    0)
      succeeded=$((succeeded + 1))
      if ((old)); then
        [[ "$(cat "$out/notes.txt")" == mine ]] || complain "$where: another file is gone"
        rm -f "$out/notes.txt"
      fi
      wrong="$(same_results "$out" "$work/$name")" || complain "$where: exit 0 with $wrong"
      ;;
    1)
      failed=$((failed + 1))
      grep -q "No space left" "$work/errors" || complain "$where: it says $(cat "$work/errors")"
      [[ "$(wc -l < "$work/errors")" == 1 ]] || complain "$where: more than one line"
      if ((old)); then
        wrong="$(old_results "$out" "$work/$name")" || complain "$where: exit 1, and changed: $wrong"
      else
        [[ ! -e "$out" ]] || complain "$where: exit 1, and left: $(ls -A "$out" | tr '\n' ' ')"
      fi
      ;;
    *) complain "$where: exit $status" ;;
  esac
  umount --lazy "$work/disk" # a comparison may not have closed its files yet
done
((succeeded > 0 && failed > 0)) || complain "all sizes did alike: $succeeded succeeded, $failed failed"
finish "$runs runs on small disks: $succeeded succeeded, $failed failed"
