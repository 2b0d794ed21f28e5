#!/usr/bin/env bash
# What a scene costs with nothing cached: processor time, time, peak memory (of the largest process) and
# libraries loaded, as a table; and the start of the program, whose median of 20 must stay under 50 ms of
# processor time:
#   bash tests/footprint.sh [PROGRAM]
set -uo pipefail
program=$(realpath "${1:-build/release/bin/cardiac}") || exit 2
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
export OPENBLAS_NUM_THREADS=1

# The beat's ventricle held at one pressure while it contracts: no circulation.
awk '/^\[/ { skip = $0 == "[circulation]" } !skip' protocols/healthy_lv.toml |
  sed "s|\"\.\./meshes|\"$PWD/meshes|; /^limit_cycle/d" >"$folder/prescribed.toml"
printf '[cavities]\npressure_mmHg = 10.0\n' >>"$folder/prescribed.toml"

failed=0
scene() {
  local name=$1
  shift
  local status=0
  XDG_CACHE_HOME=$(mktemp -d -p "$folder") /usr/bin/time -o "$folder/cost" -f "%U %S %e %M" \
    "$program" "$@" --out "$folder/out" >"$folder/log" 2>&1 || status=$?
  if ((status)); then
    cat "$folder/log" >&2
    echo "| $name | not in this build |"
    ((status == 2)) || failed=1
    return
  fi
  awk -v name="$name" -v libraries="$libraries" \
    '{ printf "| %s | %.2f | %.2f | %.0f | %d |\n", name, $1 + $2, $3, $4 / 1024, libraries }' "$folder/cost"
}

libraries=$(LD_TRACE_LOADED_OBJECTS=1 "$program" | grep -c '=>')
tables=(--quiet --set output.figures=false --set output.mesh_series=false)
echo "| scene | processor s | s | peak MB | libraries |"
echo "|---|---|---|---|---|"
scene "passive cube (\`bench cube --quick\`)" bench cube --quick
scene "passive ventricle" run protocols/passive_inflation.toml "${tables[@]}"
scene "prescribed pressure, contracting" run "$folder/prescribed.toml" "${tables[@]}"
scene "one beat" run protocols/healthy_lv.toml "${tables[@]}" --set time.max_beats=1
scene "20 beats" run protocols/healthy_lv.toml "${tables[@]}" --set time.max_beats=20 \
  --set time.limit_cycle_tolerance_percent=1e-12
scene "one beat with figures and meshes" run protocols/healthy_lv.toml --quiet --set time.max_beats=1

# In milliseconds; on a busy machine only processor time tells.
TIMEFORMAT='%R %U %S'
starts=$(for _ in {1..20}; do { time "$program" --help >/dev/null; } 2>&1; done |
  awk '{ print 1000 * ($2 + $3), 1000 * $1 }')
median() { awk -v column="$1" '{ print $column }' <<<"$starts" | sort -n | sed -n 10p; }
echo
echo "start (--help), median of 20: $(median 1) ms of processor time, $(median 2) ms"
awk -v ms="$(median 1)" 'BEGIN { exit ms >= 50 }' || failed=1
exit "$failed"
