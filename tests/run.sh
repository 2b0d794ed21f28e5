#!/usr/bin/env bash
# Installs what is missing, builds everything in release mode, runs every test and checks the format.
# Options for the long checks:
#   --sanitize  also build and run the tests with address and undefined-behaviour sanitizers
#   --tidy      also run clang-tidy over all sources
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
source apps/setup.sh

sanitize=no tidy=no
for option in "$@"; do
  case $option in
    --sanitize) sanitize=yes ;;
    --tidy) tidy=yes ;;
    *)
      echo "usage: bash tests/run.sh [--sanitize] [--tidy]" >&2
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
install_packages "${purposes[@]}" || exit 1

presets=(release)
[[ $sanitize == yes ]] && presets=(sanitize release)
for preset in "${presets[@]}"; do
  build "$preset" || exit 1
done

check_format() { sources '*.[ch]pp' | xargs -0 clang-format --dry-run -Werror; }
check_tidy() {
  sources '*.cpp' | xargs -0 --max-args=1 --max-procs="$(parallel_jobs)" clang-tidy -p build/release --quiet
}
check "clang-format" check_format
[[ $tidy == yes ]] && check "clang-tidy" check_tidy
for preset in "${presets[@]}"; do
  check "tests ($preset)" ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error
done

if ((${#failed[@]})); then
  printf 'Failed: %s\n' "${failed[@]}" >&2
  exit 1
fi
