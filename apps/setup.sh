# shellcheck shell=bash
# Functions of apps/demo.sh and tests/run.sh; to be sourced from the project's root.

# install_packages [PURPOSE...]: installs what apps/packages.txt lists and is missing, with apt; quiet when
# nothing is.
install_packages() {
  local purpose package missing=() as_root=()
  if ! command -v apt-get dpkg-query >/dev/null; then
    echo "This is not a Debian system: the packages of apps/packages.txt are not checked." >&2
    return 0
  fi
  while read -r package purpose; do
    [[ -z $package || $package == \#* ]] && continue
    [[ -n $purpose && " $* " != *" $purpose "* ]] && continue
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
      missing+=("$package")
  done <apps/packages.txt
  ((${#missing[@]})) || return 0

  echo "Installing: ${missing[*]}"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "Installing needs root or sudo; as root: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# As many compiler jobs as there are processors, but no more than fit into memory: one unit (CGAL) needs
# 3.5 GB, the others about 1 GB.
parallel_jobs() {
  local processors free_GB fitting
  processors=$(nproc)
  free_GB=$(awk '/MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo)
  fitting=$((free_GB > 4 ? free_GB - 3 : 1))
  echo $((processors < fitting ? processors : fitting))
}

# build PRESET [TARGET...]: configures when needed and builds into build/PRESET.
build() {
  local preset=$1 targets=("${@:2}")
  [[ -f build/$preset/build.ninja ]] || cmake --preset "$preset" || return
  cmake --build --preset "$preset" --target "${targets[@]:-all}" --parallel "$(parallel_jobs)"
}
