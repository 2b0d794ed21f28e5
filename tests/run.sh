#!/usr/bin/env bash
# Installs what is missing, builds everything in release mode, runs every test and checks the format.
# Options for the long checks:
#   --sanitize  also build (with Clang) and run the tests with address and undefined-behaviour sanitizers
#   --debug     also compare the tables of an unoptimised build with those of the release build (1e-8)
#   --plain     also compare the tables of a build without VTK and CGAL with those of the release build (equal)
#   --cost      also measure time, memory and libraries of some scenes and the start of the program
#   --extreme   also run `cardiac validate extreme`, in 15 minutes at most, and its --quick set, in 2
#   --tidy      also run clang-tidy over all sources
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
source apps/setup.sh

sanitize=no debug=no plain=no cost=no extreme=no tidy=no
for option in "$@"; do
  case $option in
    --sanitize) sanitize=yes ;;
    --debug) debug=yes ;;
    --plain) plain=yes ;;
    --cost) cost=yes ;;
    --extreme) extreme=yes ;;
    --tidy) tidy=yes ;;
    *)
      echo "usage: bash tests/run.sh [--sanitize] [--debug] [--plain] [--cost] [--extreme] [--tidy]" >&2
      exit 2
      ;;
  esac
done

sources() { find apps libcardiac libpolyaffine tests -name "$1" -print0; }
failed=()
check() {
  local name=$1
  shift
  "$@" || failed+=("$name")
}

purposes=(tests)
[[ $tidy == yes ]] && purposes+=(tidy)
[[ $sanitize == yes ]] && purposes+=(sanitize)
install_packages "${purposes[@]}" || exit 1

presets=(release)
[[ $sanitize == yes ]] && presets=(sanitize release)
for preset in "${presets[@]}"; do
  build "$preset" || exit 1
done
if [[ $debug == yes ]]; then
  build debug cardiac_app || exit 1
fi
if [[ $plain == yes ]]; then
  build plain cardiac_app || exit 1
fi

same_tables() { bash tests/same_tables.sh build/release/bin/cardiac "build/$1/bin/cardiac" "$2"; }
check_format() { sources '*.[ch]pp' | xargs -0 clang-format --dry-run -Werror; }
check_tidy() {
  sources '*.cpp' | xargs -0 --max-args=1 --max-procs="$(parallel_jobs)" clang-tidy -p build/release --quiet
}
check "clang-format" check_format
check "layers" python3 tests/layers.py
[[ $tidy == yes ]] && check "clang-tidy" check_tidy
for preset in "${presets[@]}"; do
  check "tests ($preset)" ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error
done
[[ $plain == yes ]] && check "tables (plain)" same_tables plain 0
[[ $debug == yes ]] && check "tables (debug)" same_tables debug 1e-8
extremes() { timeout "$1" build/release/bin/cardiac validate extreme --out build/extremes "${@:2}"; }
if [[ $extreme == yes ]]; then
  check "extremes (quick, 2 minutes)" extremes 120 --quick
  check "extremes (15 minutes)" extremes 900
fi
[[ $cost == yes ]] && check "cost of scenes" bash tests/footprint.sh

if ((${#failed[@]})); then
  printf 'Failed: %s\n' "${failed[@]}" >&2
  exit 1
fi
