#!/usr/bin/env bash
# Writes docs/speed_and_error.md and its pictures from `whirl accuracy`: ./run speed_and_error
# Usage: speed_and_error.sh PROGRAM PROJECT_ROOT
set -euo pipefail

program="$1"
root="$2"
cases=(friswell_5_9_1 friswell_taper lalanne_three_discs centrifuge_five_balls)
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# table FILE: accuracy.csv as a Markdown table, times in ms.
table() {
  echo "| family | order | elements | method | unknowns | ms | error estimate | true error |"
  echo "|---|--:|--:|---|--:|--:|--:|--:|"
  awk -F, 'function digits(x) { return x == "" ? "–" : sprintf("%.1e", x) }
    NR > 1 { printf "| %s | %d | %d | %s | %d | %.2f | %s | %s |\n",
             $1, $2, $3, $4, $5, 1000 * $6, digits($7), digits($8) }' "$1"
}

{
  cat << 'END'
# Speed and error

How long one spin speed takes and how large its error is, for the classical two-node element on finer and
finer meshes and for elements of higher order. Made by `./run speed_and_error`, which runs the
[accuracy](../src/analyses/accuracy.h) command on four cases: two without damping, one damped, one with an auto-balancer.

- **ms**: wall time to assemble, factorise and solve at one speed, best of three, without the start of the
  program. A Campbell diagram assembles and factorises once for all speeds. Symmetric problems of up to 200
  unknowns are moreover diagonalised at rest: a single speed pays for that, as the times just below 200
  unknowns show, each further one gains.
- **Method**: full is that. Reduced: modes of damped rotors with symmetric matrices followed through
  up to 25 speeds of the case's range, as `campbell` does: guessed from speeds nearby, corrected with the whole matrices.
  The time is that of one of these speeds, with its part of what is done once, the error that of the whole rotor.
- **Error estimate**: 1.25 times the difference to order p + 4 on the same elements.
- **True error**: largest relative difference of the eigenvalues asked for from those of the reference named
  above each table. An error below the reference's own (against two orders lower) is only rounding.

END
  printf 'Measured on %s cores (%s). Absolute times drift;\n' \
    "$(nproc)" "$(awk -F': ' '/^model name/ {print $2; exit}' /proc/cpuinfo)"
  echo 'compare within a table.'
  for name in "${cases[@]}"; do
    "$program" accuracy "$root/cases/$name" --out "$scratch/$name" > "$scratch/$name.txt"
    {
      IFS= read -r title
      IFS= read -r against
    } < "$scratch/$name.txt"
    printf '\n## %s\n\n[cases/%s](../cases/%s/README.md). %s.\n\n' "$title" "$name" "$name" "$against"
    printf '![Error over unknowns and wall time](images/accuracy_%s.png)\n\n' "$name"
    table "$scratch/$name/accuracy.csv"
  done
  # The last section is made by keep_ratios.sh.
  echo
  sed -n '/^## Times as ratios/,$p' "$root/docs/speed_and_error.md"
} > "$scratch/page.md"

# Only now, with every part made, the pages change.
for name in "${cases[@]}"; do
  cp "$scratch/$name/accuracy.png" "$root/docs/images/accuracy_$name.png"
done
cp "$scratch/page.md" "$root/docs/speed_and_error.md"
echo "$root/docs/speed_and_error.md"
