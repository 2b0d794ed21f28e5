#!/usr/bin/env bash
# Installs a build, moves what it installed elsewhere, and uses it as a stranger would:
#   bash tests/consumers.sh BUILD_FOLDER
# - the installed files name neither the project's folder nor the prefix they were installed into;
# - tests/consumers and every folder of examples/ are configured with find_package alone, built without any
#   processor flag, optimised and not, and with -march=x86-64-v3 where this machine has it, and run; what an
#   example prints is what its opening comment shows.
set -uo pipefail
if (($# != 1)); then
  echo "usage: bash tests/consumers.sh BUILD_FOLDER" >&2
  exit 2
fi
build=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
root=$PWD
work=$build/consumers prefix=$build/consumers/installed
rm -rf "$work"
mkdir -p "$work/first"
cmake --install "$build" --prefix "$work/first/prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
mv "$work/first/prefix" "$prefix"

failed=0
fail() { echo "consumers: $*" >&2; failed=1; }
named=$(grep -rlF --include='*.cmake' --include='*.hpp' -e "$root" -e "$work/first" "$prefix")
[[ -z $named ]] || fail "files that name a folder of this machine: $named"

variants=("plain|-O2" "unoptimised|-O0")
grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo && variants+=("x86_64_v3|-O2 -march=x86-64-v3")

# make SOURCE VARIANT FLAGS
make() {
  cmake -G Ninja -S "$1" -B "$work/$(basename "$1")/$2" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="$3 -Wall -Wextra -Werror" &&
    cmake --build "$work/$(basename "$1")/$2"
}
# The lines behind "$ NAME" in the opening comment of an example.
promised() { sed -n "/^\/\/     \$ $1/,/^\/\/\$\|^\$/ { s/^\/\/     //; t print; d; :print; /^\\$/ ! p }" "$2"; }

for variant in "${variants[@]}"; do
  name=${variant%%|*} flags=${variant#*|}
  if make tests/consumers "$name" "$flags" >"$work/log" 2>&1; then
    for program in layout heart parts; do
      [[ -x $work/consumers/$name/$program || $program != parts ]] || continue
      (cd "$work/consumers/$name" && "./$program" >"$program.txt") || fail "$program ($name)"
    done
  else
    cat "$work/log"
    fail "tests/consumers ($name) does not build"
  fi
  for example in examples/*/; do
    example=${example%/}
    program=$(basename "$example")
    if ! make "$example" "$name" "$flags" >"$work/log" 2>&1; then
      cat "$work/log"
      fail "$example ($name) does not build"
      continue
    fi
    folder=$work/$program/$name
    (cd "$folder" && "./$program" >"$program.txt") || fail "$example ($name) fails"
    diff <(promised "$program" "$example/$program.cpp") "$folder/$program.txt" ||
      fail "$example ($name) prints other lines than its comment"
  done
done
((failed)) || echo "The installed libraries serve programs compiled with other flags (${variants[*]%%|*})."
exit "$failed"
