#!/usr/bin/env bash
# How much the tests see: faults seeded into the numerics one at a time, and the tests of the room they are in.
# Usage: run.sh ROOT BUILD [WORDS]   (./run mutants [WORDS]: only faults whose names contain WORDS)
# The faults stand in list.txt. All are compiled into one program, each behind a switch: WHIRL_MUTANT=N in the
# environment turns that of the number N on (faults.tsv). A fault is caught where a test that passes without it fails with it. Where tests fail
# without the fault too, or a filter names no test, it is BROKEN: neither caught nor a survivor.
# Exit status 0: at least 95 of 100 are caught, none is broken.
set -euo pipefail
set -f # filters have asterisks
root="$1" build="$2" words="${3-}"
here="$root/tests/mutants"
mkdir -p "$build/source"

# The sources with the switches; a file that did not change keeps its time, so that little is built again.
git -C "$root" ls-files -z --cached --others --exclude-standard |
  perl "$here/seed.pl" "$here/list.txt" "$root" "$build/source" > "$build/faults.tsv"

[[ -f "$build/build/build.ninja" ]] ||
  cmake -S "$build/source" -B "$build/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER=clang++ -DWHIRL_BENCHMARKS=OFF > "$build/configure.log"
mapfile -t programs < <(cut -f4 "$build/faults.tsv" | tr ' ' '\n' | grep '_tests$' | sort -u)
ninja -C "$build/build" whirl "${programs[@]}" > "$build/build.log" || { tail -n 40 "$build/build.log"; exit 2; }

# run_tests FOLDER NUMBER TESTS: programs, each followed by its filter if it has one ("modes_tests Form.*"), with the
# fault of this number, in a folder of their own. NUMBER 0: without any; every part of a filter must name a test.
run_tests() {
  set -f
  local folder="$1" number="$2" word program="" runs=()
  for word in $3; do
    if [[ "$word" == *_tests ]]; then
      program="$(find "$tests_of_mutants" -type f -name "$word" -perm -u+x)"
      runs+=("$program *")
    else
      runs[-1]="$program $word"
    fi
  done
  mkdir -p "$folder"
  cd "$folder"
  export WHIRL_MUTANT="$number" TEST_TMPDIR="$folder"
  for word in "${runs[@]}"; do
    local filter="${word#* }" part
    if ((number == 0)); then
      for part in ${filter//:/ }; do
        "${word%% *}" --gtest_list_tests --gtest_filter="$part" 2> /dev/null < /dev/null | grep -q '^  ' ||
          { echo "no test is named $part"; return 1; }
      done
    fi
    timeout 600 "${word%% *}" --gtest_brief=1 --gtest_fail_fast --gtest_filter="$filter" 2>&1 < /dev/null || return 1
  done
}
# with_and_without NUMBER TESTS: a line of `number <tab> passes or fails`, for 0 with the tests.
with_and_without() {
  local folder result=fails
  folder="$(mktemp -d "$runs_of_mutants/XXXXXX")"
  (run_tests "$folder" "$1" "$2" > "$folder.log") && result=passes
  [[ "$1" == 0 && $result == fails ]] && tail -n 5 "$folder.log" >&2
  rm -rf "$folder" "$folder.log"
  printf '%s\t%s\t%s\n' "$1" "$result" "$2"
}
export -f run_tests with_and_without
export tests_of_mutants="$build/build/tests" runs_of_mutants="$build/runs"
rm -rf "$runs_of_mutants"
mkdir -p "$runs_of_mutants"
# several: with_and_without for lines of number and tests, one on every processor.
several() {
  tr '\t\n' '\0\0' | xargs -0 -r -n 2 -P "$(nproc)" bash -c 'with_and_without "$1" "$2"' run
}

chosen() { awk -F '\t' -v OFS='\t' -v words="$words" 'index($2, words) { print $1, $2, $3, $4 }' "$build/faults.tsv"; }
without="$(chosen | cut -f4 | sort -u | sed 's/^/0\t/' | several | tee "$build/without.tsv")"
sound="$(grep -P '^0\tpasses' <<< "$without" | cut -f3)"
with="$(chosen | awk -F '\t' -v OFS='\t' -v sound="$sound" '
  BEGIN { n = split(sound, list, "\n"); for (i = 1; i <= n; ++i) known[list[i]] = 1 }
  $4 in known { print $1, $4 }' | several | tee "$build/with.tsv")"

caught=0 seeded=0 broken=0
while IFS=$'\t' read -r number name file tests; do
  if grep -q -F -x -- "$number"$'\tpasses\t'"$tests" <<< "$with"; then
    echo "SURVIVES $name ($file): $tests"
  elif grep -q -F -x -- "$number"$'\tfails\t'"$tests" <<< "$with"; then
    caught=$((caught + 1))
    echo "caught   $name"
  else
    echo "BROKEN   $name: its tests fail without it, or are none: $tests"
    broken=$((broken + 1))
    continue
  fi
  seeded=$((seeded + 1))
done < <(chosen)
((broken == 0)) || echo "$broken broken"
echo "$caught of $seeded seeded faults caught"
((!broken && seeded && 100 * caught >= 95 * seeded))
