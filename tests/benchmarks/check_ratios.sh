#!/usr/bin/env bash
# Fails where a workload takes more than twice its reference time, both in units of a dense
# eigendecomposition measured beside it: ./run benchmark_ratios check
# What looks too slow is measured a second time; the better one counts.
# Usage: check_ratios.sh PROGRAM REFERENCE_CSV
set -euo pipefail

program="$1"
reference="$2"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# too_slow MEASURED_CSV...: a line for each workload whose best time is too long, or that only one
# side knows: its name, then the reason.
too_slow() {
  awk -F, '
    /^#/ || $1 == "workload" || NF < 3 { next }
    FILENAME == ARGV[1] { wanted[$1] = $3; next }
    !($1 in best) || $3 < best[$1] { best[$1] = $3 }
    END {
      for (name in best)
        if (!(name in wanted))
          print name " has no reference"
      for (name in wanted)
        if (!(name in best))
          print name " was not measured"
        else if (!(best[name] + 0 <= 2 * wanted[name]))
          printf "%s takes %.4g units, %.2f times the reference of %.4g (at most 2)\n",
                 name, best[name], best[name] / wanted[name], wanted[name]
    }' "$reference" "$@" | sort
}

"$program" --csv "$scratch/first.csv"
slow="$(too_slow "$scratch/first.csv")"
mapfile -t again < <(awk '/ takes / { print $1 }' <<< "$slow")
if ((${#again[@]})); then
  printf '\nOnce more: %s\n' "${again[*]}"
  "$program" --csv "$scratch/second.csv" "${again[@]}"
  slow="$(too_slow "$scratch/first.csv" "$scratch/second.csv")"
fi
if [[ -z "$slow" ]]; then
  echo "no workload takes more than twice its reference time"
  exit 0
fi
{
  printf '\nslower than %s allows:\n%s\n' "$reference" "$slow"
  grep '^#' "$reference" || true
  echo "If this is meant, or on another kind of processor: ./run benchmark_ratios reference"
} >&2
exit 1
