#!/usr/bin/env bash
# How much the tests see: faults seeded into the numerics one at a time, and the tests of the room they are in.
# Usage: run.sh ROOT BUILD [WORDS]   (./run mutants [WORDS]: only faults whose names contain WORDS)
# The faults stand in list.txt. All are compiled into one program, each behind a switch: WHIRL_MUTANT=N in the
# environment turns the N-th on. A fault is caught where a test that passes without it fails with it.
# Exit status 0: at least 95 of 100 are caught.
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

# run_tests NUMBER TESTS: programs, each followed by its filter if it has one ("modes_tests Form.*").
run_tests() {
  local number="$1" program="" filter="" word status=0
  one() {
    [[ -z "$program" ]] && return 0
    (cd "$build/build/tests" && WHIRL_MUTANT="$number" timeout 600 \
      "$(find . -type f -name "$program" -perm -u+x)" --gtest_brief=1 --gtest_fail_fast --gtest_filter="${filter:-*}") \
      > "$build/last.log" 2>&1 < /dev/null || return 1
    ! grep -q '^\[==========\] 0 tests' "$build/last.log" # a filter that nothing passes sees nothing
  }
  for word in $2; do
    if [[ "$word" == *_tests ]]; then
      one || status=1
      program="$word" filter=""
    else
      filter="$word"
    fi
    ((status)) && return 1
  done
  one
}

caught=0 seeded=0 broken=0
while IFS=$'\t' read -r number name file tests; do
  [[ -z "$words" || "$name" == *"$words"* ]] || continue
  if ! run_tests 0 "$tests"; then
    echo "BROKEN   $name: its tests fail without the fault: $tests"
    broken=1
    continue
  fi
  seeded=$((seeded + 1))
  if run_tests "$number" "$tests"; then
    echo "SURVIVES $name ($file): $tests"
  else
    caught=$((caught + 1))
    echo "caught   $name"
  fi
done < "$build/faults.tsv"
echo "$caught of $seeded seeded faults caught"
((!broken && 100 * caught >= 95 * seeded))
