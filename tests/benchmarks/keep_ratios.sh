#!/usr/bin/env bash
# Measures tests/benchmarks/ratios.csv anew, and with it that section of docs/speed_and_error.md:
# ./run benchmark_ratios reference
# Usage: keep_ratios.sh PROGRAM PROJECT_ROOT
set -euo pipefail

program="$1"
root="$2"
reference="$root/tests/benchmarks/ratios.csv"
page="$root/docs/speed_and_error.md"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

processor="$(awk -F': ' '/^model name/ {print $2; exit}' /proc/cpuinfo)"
read -r load _ < /proc/loadavg
shared=""
awk -v load="$load" 'BEGIN { exit !(load > 0.5) }' &&
  shared="; the cores were shared with other programs (load average $load at the start)"
where="Measured on $(nproc) cores ($processor)$shared."

# Also what is long three times: some four minutes.
"$program" --once 1e9 --limit 1e9 --csv "$scratch/ratios.csv"

section() {
  cat << 'END'
## Times as ratios

What the commands take, in units that a slower machine stretches as well. Made by
`./run benchmark_ratios reference` from calls of the library: no pictures, no start of the program.

- **ms**: processor time, so that waiting for a busy core does not count.
- **Units**: the same divided by one dense eigendecomposition (LAPACK's dgeev with right eigenvectors) of a
  full 392 × 392 matrix, the state matrix of the rotor with three discs on 48 classical elements, with
  OpenBLAS's loops for Haswell where the processor has them.
- **Dense route**: how many times as long the straightforward way to the same numbers takes, solves alone. Campbell
  diagrams: dgeev of the 392 × 392 state matrix at every speed (48 classical elements, four to five digits). Response:
  a full complex system (zgesv, 772 unknowns) at every speed, orbits, errors and peaks not included.

The rotor with three discs has 100 N s/m in both bearings. Unit and dense route are measured before and after each
run; the least times of three runs count (in a check, what takes more than 5 s runs once). Samples: the run divided by their
number, with what the case as it is takes. Cases as they are in `cases/` where nothing else is said.

END
  printf '%s\n\n' "$where"
  echo "| workload | what | ms | units | dense route |"
  echo "|---|---|--:|--:|--:|"
  awk -F, 'NR > 1 { printf "| %s | %s | %.0f | %.3g | %s |\n", $1, $5, 1000 * $2, $3,
                    $4 == "" ? "–" : sprintf("%.3g", $4) " ×" }' "$scratch/ratios.csv"
  cat << 'END'

`./run benchmark_ratios` prints the table as it is now and writes it to `out/benchmark_ratios.json` and `.csv`.
`./run benchmark_ratios check`, a step of `.ci/run`, fails where a workload takes more than twice the units of
[ratios.csv](../tests/benchmarks/ratios.csv), also when measured a second time.
END
}

{
  printf '%s\n\n' "$(sed '/^## Times as ratios/,$d' "$page")"
  section
  awk '/^## / { after = seen; seen = seen || /^## Times as ratios/; if (after && !begun++) print "" } after' "$page"
} > "$scratch/page.md"
{
  echo "# $where"
  cat "$scratch/ratios.csv"
} > "$reference"
cp "$scratch/page.md" "$page"
printf '%s\n%s\n' "$reference" "$page"
