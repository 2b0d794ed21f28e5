#!/usr/bin/env bash
# Installs what is missing and runs, one stage after the other, and says how long each took:
#   format, layers   clang-format, the order of the folders and the lists of sources
#   build, consumers, headers, tests
#                    the release build; programs against its installed libraries; every installed header alone;
#                    every test
# Options:
#   --ci        two stages more: `plain`, the build without VTK and CGAL with those tests that need neither, and
#               `sanitizers`, the tests of some folders of libpolyaffine, built with Clang, under address and
#               undefined-behaviour sanitizers
#   --sanitize  all tests under sanitizers
#   --debug     also compare the tables of an unoptimised build with those of the release build (1e-8)
#   --plain     also compare the tables of the plain build with those of the release build (equal)
#   --cost      also measure time, memory and libraries of some scenes and the start of the program
#   --extreme   also run `cardiac validate extreme`, in 15 minutes at most, and its --quick set, in 2
#   --tidy      also run clang-tidy over all sources
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
source apps/setup.sh

ci=no sanitize=no debug=no plain=no cost=no extreme=no tidy=no
for option in "$@"; do
  case $option in
    --ci) ci=yes ;;
    --sanitize) sanitize=yes ;;
    --debug) debug=yes ;;
    --plain) plain=yes ;;
    --cost) cost=yes ;;
    --extreme) extreme=yes ;;
    --tidy) tidy=yes ;;
    *)
      echo "usage: bash tests/run.sh [--ci] [--sanitize] [--debug] [--plain] [--cost] [--extreme] [--tidy]" >&2
      exit 2
      ;;
  esac
done

# Folders of libpolyaffine whose tests are quick to build and run: raw memory, files, packs, solvers.
sanitized_folders=(core mesh_io material kinematics linear system)

sources() { find apps examples libcardiac libpolyaffine tests -name "$1" -print0; }
failed=() times=()
check() {
  local name=$1 start=$SECONDS
  shift
  echo "== $name"
  "$@" || failed+=("$name")
  times+=("$(printf '%5d s  %s' $((SECONDS - start)) "$name")")
}
finish() {
  printf '%s\n' "${times[@]}"
  ((${#failed[@]})) || exit 0
  printf 'Failed: %s\n' "${failed[@]}" >&2
  exit 1
}

purposes=(tests)
[[ $tidy == yes ]] && purposes+=(tidy)
[[ $sanitize == yes || $ci == yes ]] && purposes+=(sanitize)
install_packages "${purposes[@]}" || exit 1

check_format() { sources '*.[ch]pp' | xargs -0 clang-format --dry-run -Werror; }
check_tidy() {
  sources '*.cpp' | grep --null-data --invert-match --extended-regexp '^(examples|tests/consumers)/' |
    xargs -0 --max-args=1 --max-procs="$(parallel_jobs)" clang-tidy -p build/release --quiet
}
check_headers() {
  local eigen
  eigen=$(grep --only-matching --max-count=1 --extended-regexp -e '-isystem [^ ]*eigen3' build/release/compile_commands.json)
  python3 tests/headers.py build/release/consumers/installed/include "${eigen#-isystem }"
}
run_tests() { ctest --preset "$1" --parallel "$(nproc)" --no-tests=error "${@:2}"; }
same_tables() { bash tests/same_tables.sh build/release/bin/cardiac "build/$1/bin/cardiac" "$2"; }
extremes() { timeout "$1" build/release/bin/cardiac validate extreme --out build/extremes "${@:2}"; }

check "format" check_format
check "layers" python3 tests/layers.py
check "build" build release
[[ " ${failed[*]} " == *" build "* ]] && finish
check "consumers" bash tests/consumers.sh build/release
check "headers" check_headers
[[ $tidy == yes ]] && check "clang-tidy" check_tidy
check "tests" run_tests release
if [[ $ci == yes || $plain == yes ]]; then
  check "plain: build" build plain
  check "plain: tests" run_tests plain
fi
[[ $plain == yes ]] && check "plain: tables" same_tables plain 0
if [[ $sanitize == yes ]]; then
  check "sanitizers: build" build sanitize
  check "sanitizers: tests" run_tests sanitize
elif [[ $ci == yes ]]; then
  check "sanitizers: build" build sanitize "${sanitized_folders[@]/#/test_polyaffine_}"
  check "sanitizers: tests" run_tests sanitize --tests-regex "^polyaffine/($(IFS='|'; echo "${sanitized_folders[*]}"))/"
fi
if [[ $debug == yes ]]; then
  check "debug: build" build debug cardiac_app
  check "debug: tables" same_tables debug 1e-8
fi
if [[ $extreme == yes ]]; then
  check "extremes (quick, 2 minutes)" extremes 120 --quick
  check "extremes (15 minutes)" extremes 900
fi
[[ $cost == yes ]] && check "cost of scenes" bash tests/footprint.sh
finish
