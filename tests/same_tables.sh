#!/usr/bin/env bash
# Runs one beat and one passive inflation on the coarse ellipsoid with two builds of the program and compares
# their tables number by number; neither sees what the other has cached:
#   bash tests/same_tables.sh PROGRAM OTHER_PROGRAM TOLERANCE
# A difference is |a - b| over the largest magnitude in its column, and 0 for equal words. Prints the largest
# of each table; status 1 when one exceeds the tolerance, or when a table differs in its rows or words.
set -uo pipefail
if (($# != 3)); then
  echo "usage: bash tests/same_tables.sh PROGRAM OTHER_PROGRAM TOLERANCE" >&2
  exit 2
fi
programs=("$(realpath "$1")" "$(realpath "$2")") tolerance=$3
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

compare() {
  awk -F, -v tolerance="$tolerance" -v table="$3" '
    function is_number(word) { return word ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
    NR == FNR { row[FNR] = $0; rows = FNR; next }
    {
      if (FNR > rows || split(row[FNR], first) != NF) { print table ": other rows"; failed = 1; exit }
      for (i = 1; i <= NF; ++i) {
        if (!is_number(first[i]) || !is_number($i)) {
          if (first[i] "" != $i "") { print table ", line " FNR ": " first[i] " and " $i; failed = 1; exit }
          continue
        }
        a = first[i] + 0; b = $i + 0
        if (a < 0) { size = -a } else { size = a }
        if (size > largest[i]) largest[i] = size
        d = a > b ? a - b : b - a
        if (d > difference[i]) difference[i] = d
        ++numbers
      }
      seen = FNR
    }
    END {
      if (failed) exit 1
      if (seen != rows || numbers < 20) { print table ": other rows, or none"; exit 1 }
      for (i in difference) {
        relative = difference[i] == 0 ? 0 : difference[i] / (largest[i] > 0 ? largest[i] : 1)
        if (relative > worst) worst = relative
      }
      printf "%-32s %7d numbers, largest difference %.2g of the column\n", table, numbers, worst
      exit worst > tolerance
    }' "$1" "$2"
}

failed=0
run_both() {
  local name=$1 table k
  shift
  for k in 0 1; do
    XDG_CACHE_HOME="$folder/cache$k" "${programs[k]}" run "$@" --quiet --out "$folder/$name$k" --set output.figures=false \
      --set 'mesh.file="meshes/land_ellipsoid_coarse.vtu"' >/dev/null || { failed=1; return; }
  done
  for table in strain.csv strain_peaks.csv affine.csv global_strain.csv cavity.csv; do
    compare "$folder/${name}0/$table" "$folder/${name}1/$table" "$name/$table" || failed=1
  done
}
run_both beat protocols/healthy_lv.toml --set time.max_beats=1
run_both passive protocols/passive_inflation.toml
run_both full_order protocols/passive_inflation.toml --method fem
exit "$failed"
