# Sourced by start.sh and test.sh: installs the packages that are missing, then configures the release preset
# and builds all of it or one target.
# shellcheck shell=bash

# usage: missing_packages LIST...
# Prints the packages of the lists that are not installed, one a line.
missing_packages() {
  local name
  while read -r name; do
    if [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$name" 2>/dev/null)" != installed ]]; then
      echo "$name"
    fi
  done < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$@")
}

# usage: install_missing_packages LIST...
install_missing_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is no Debian system: please install what $* names by hand, if the build asks for it." >&2
    return 0
  fi
  local -a missing
  mapfile -t missing < <(missing_packages "$@")
  if [[ ${#missing[@]} -eq 0 ]]; then
    return 0
  fi
  local -a as_root=(env DEBIAN_FRONTEND=noninteractive)
  if [[ "$(id -u)" -ne 0 ]]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing, and installing them takes root or sudo:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo "${as_root[@]}")
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# usage: set_up [TARGET...], without any all, with the Python module. Expects the project's root as the working directory.
# Of the environment: VEGARD_WARNINGS_AS_ERRORS=ON, and a warning ends it; VEGARD_INSTRUCTION_SETS, by default "this": vector code
# for this machine's processor alone, with the same results as "all" and compiled in a third of the time.
set_up() {
  local -a lists=(packages.txt) options=("-DVEGARD_WARNINGS_AS_ERRORS=${VEGARD_WARNINGS_AS_ERRORS:-OFF}"
    "-DVEGARD_INSTRUCTION_SETS=${VEGARD_INSTRUCTION_SETS:-this}")
  local -a targets=("$@")
  [[ $# -gt 0 ]] || targets=(all)
  if [[ " ${targets[*]} " == *" all "* || " ${targets[*]} " == *" vegard_python "* ]]; then
    lists+=(packages-python.txt)
    options+=(-DVEGARD_PYTHON=ON)
  fi
  install_missing_packages "${lists[@]}"
  cmake --preset release "${options[@]}"
  cmake --build --preset release -j "$(nproc)" --target "${targets[@]}"
}
