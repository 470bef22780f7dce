#!/bin/bash
# Sets quadmap up on Debian 12 and puts it to work. Safe to repeat: what is there is not done again.
#   ./quickstart.sh demo      maps the bundled recording, whose odometry drifts, and shows what came of it
#   ./quickstart.sh test      runs all tests
#   ./quickstart.sh packages [build|test|ci|packages]...   only installs the Debian packages that are missing
set -euo pipefail
export LC_ALL=C.UTF-8

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)
build=$root/build/release
logs=$root/build/logs

say() { printf '== %s\n' "$*"; }
fail() { printf 'quickstart: %s\n' "$*" >&2; exit 1; }

# quietly NAME COMMAND...: the output goes to a log, of which the end is shown when the command fails.
quietly() {
  local log=$logs/$1.log
  shift
  mkdir -p "$logs"
  "$@" >"$log" 2>&1 </dev/null || { tail -n 60 "$log" >&2; fail "failed: $* (all of it: $log)"; }
}

# missing GROUP...: the packages of these groups that are not installed.
missing() {
  local group package
  while read -r group package; do
    [[ " $* " == *" $group "* ]] || continue
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
  done <"$root/cmake/debian-packages.txt"
}

install_packages() {
  command -v dpkg-query >/dev/null || fail "this is not Debian: install what doc/dependencies.md lists, then use cmake --preset release"
  local packages admin=()
  mapfile -t packages < <(missing "$@")
  if ((${#packages[@]} == 0)); then say "Debian packages: all there"; return; fi
  if ((EUID != 0)); then
    { command -v sudo && { [[ -t 0 ]] || sudo -n true; }; } &>/dev/null || fail \
      "cannot become root; as root, run: apt-get install --no-install-recommends ${packages[*]}"
    admin=(sudo)
    say "the missing Debian packages are installed with sudo"
    sudo -n true 2>/dev/null || sudo -v
  fi
  say "Debian packages: installing ${packages[*]}"
  quietly apt-update "${admin[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update
  quietly apt-install "${admin[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${packages[@]}"
}

# A compiler process may take a gigabyte and a half.
parallel_jobs() {
  local byMemory=$(($(awk '/MemAvailable/ {print $2}' /proc/meminfo) / 1500000)) cores
  cores=$(nproc)
  ((byMemory < cores)) && cores=$byMemory
  echo $((cores > 0 ? cores : 1))
}

# build_targets TARGET...
build_targets() {
  local strict=OFF
  [[ ${CI:-false} == false ]] || strict=ON
  say "configuring $build"
  (cd "$root" && quietly configure cmake --preset release -DQUADMAP_WARNINGS_AS_ERRORS=$strict -DQUADMAP_TOGETHER=ON)
  say "building $* ($(parallel_jobs) jobs)"
  if [[ -t 1 ]]; then
    cmake --build "$build" --target "$@" -- -j "$(parallel_jobs)" || fail "the build failed"
  else
    quietly build cmake --build "$build" --target "$@" -- -j "$(parallel_jobs)"
  fi
}

demo() {
  local in=$root/rawlogs/home out=$root/build/demo
  install_packages build
  build_targets programs
  PATH=$build/bin:$PATH "$root/share/quadmap/examples/demo" "$in.rawlog" "$out"
}

run_tests() {
  install_packages build test
  build_targets all
  say "running the tests"
  ctest --test-dir "$build" --output-on-failure -j "$(nproc)" </dev/null
  local skipped
  skipped=$(grep -aE '^\[  SKIPPED \] .* \([0-9]+ ms\)$' "$build/Testing/Temporary/LastTest.log" | sort -u || true)
  [[ -z $skipped ]] || say "not run here:"$'\n'"$skipped"
}

case "${1:-}:$#" in
  demo:1) demo ;;
  test:1) run_tests ;;
  packages:*) shift; install_packages "${@:-build}" ;;
  *) sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
esac
