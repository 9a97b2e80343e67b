#!/usr/bin/env bash
# Ends runs of several commands by signals at random times: results are there as a whole or not at all, old ones are
# whole too, no temporary file and no gnuplot stays, and the exit status is 128 + the signal.
# Usage: kills.sh PROGRAM ROOT [KILLS] [SEED]
program="$1" root="$2" kills="${3:-24}"
RANDOM="${4:-1}"
# shellcheck source=tests/faults/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
export WHIRL_FAULT_TEST="$work" # by which what was started is known

microseconds() { echo $((${EPOCHREALTIME/[.,]/})); }
declare -A arguments lasts
commands=()
reference() { # NAME ARGUMENT...
  commands+=("$1")
  arguments[$1]="${*:2}"
  local start
  start="$(microseconds)"
  "$program" ${arguments[$1]} --quiet --out "$work/$1"
  lasts[$1]=$(($(microseconds) - start))
}
reference campbell campbell "$root/cases/friswell_5_9_1"
reference response response "$root/cases/nelson_mcvaugh" --set speeds.count=21
reference show show "$root/cases/composite_rotor"
reference samples samples "$root/cases/uncertain_jeffcott" --set samples.count=300
reference simulate simulate "$root/cases/rodrigues_two_plane"
reference stability stability "$root/cases/anisotropic_disc_flexible" --set speeds.count=5

# left_over: processes of this test that are still there, beside the scripts'.
left_over() {
  local environment pid
  for environment in /proc/[0-9]*/environ; do
    pid="${environment//[^0-9]/}"
    [[ "$({ tr '\0' '\n' < "$environment"; } 2> /dev/null)" == *"WHIRL_FAULT_TEST=$work"* ]] || continue
    [[ "$(cat "/proc/$pid/comm" 2> /dev/null)" =~ ^(whirl|gnuplot) ]] && echo "$pid"
  done
  return 0
}

# catches PID NUMBER: it is beyond the loading of its libraries, and looks at this signal.
catches() {
  local mask
  mask="$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2> /dev/null)" || return 1
  [[ -n "$mask" ]] && (((0x$mask >> ($2 - 1)) & 1))
}

signals=(INT TERM HUP QUIT USR1 TERM INT KILL)
before=0 after=0 restarts=0
for ((kill = 0; kill < kills; kill++)); do
  name="${commands[kill % ${#commands[@]}]}"
  signal="${signals[RANDOM % ${#signals[@]}]}"
  number="$(builtin kill -l "$signal")"
  out="$work/out$kill" old=$((RANDOM % 2))
  ((old)) && put_old_results "$out" "$work/$name"
  delay=$((lasts[$name] * (RANDOM % 1000) / 1000))
  status=0
  "$program" ${arguments[$name]} --quiet --out "$out" 2> "$work/errors" &
  victim=$!
  sleep "$(printf '%d.%06d' $((delay / 1000000)) $((delay % 1000000)))"
  begun=0
  catches "$victim" "$number" && begun=1
  builtin kill -s "$signal" "$victim" 2> /dev/null || true
  wait "$victim" 2> /dev/null || status=$?
  where="kill $kill, SIG$signal to $name after $delay us"
  if ((old)); then
    [[ "$(cat "$out/notes.txt")" == mine ]] || complain "$where: another file is gone"
  fi
  if compgen -G "$out/.*.part" > /dev/null; then complain "$where: left $(ls -A "$out" | tr '\n' ' ')"; fi
  if [[ "$name" == simulate && "$signal" == INT && -e "$out/restart.json" ]]; then
    restarts=$((restarts + 1))
    grep -q "to go on add --set simulate.restart=" "$work/errors" || complain "$where: it says $(cat "$work/errors")"
    "$program" ${arguments[$name]} --quiet --out "$work/rest" --set "simulate.restart=$out/restart.json" ||
      complain "$where: cannot go on from $out/restart.json"
    rm "$out/restart.json"
  fi
  if ((old)); then
    kept="$(old_results "$out" "$work/$name")" && whole=0 || whole=1
    rm -f "$out/notes.txt"
  else
    [[ -e "$out" && -n "$(ls -A "$out")" ]] && whole=1 || whole=0
  fi
  if ((whole)); then
    wrong="$(same_results "$out" "$work/$name")" || complain "$where: half written, $wrong ${kept-}"
    after=$((after + 1))
  else
    before=$((before + 1))
  fi
  if ((status == 0)); then
    ((whole)) || complain "$where: exit 0 without results"
  elif ((status != 128 + number)); then
    complain "$where: exit $status: $(cat "$work/errors")"
  elif ((begun)) && [[ "$(wc -l < "$work/errors")" != 1 ]]; then
    complain "$where: it says $(cat "$work/errors")"
  fi
  rm -rf "$out"
done
sleep 1
rest="$(left_over)"
[[ -z "$rest" ]] || complain "still there: $rest"
((before > 0)) || complain "none was early enough"
finish "$kills kills: $before left nothing new, $after all results, $restarts a restart"
