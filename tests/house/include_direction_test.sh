#!/usr/bin/env bash
# The rules of the house that can be read off the sources (docs/architecture.md, rules 1, 2 and 6).
# usage: include_direction_test.sh ROOT
# Prints one line per violation; exit code 1 if there is any.
set -euo pipefail
cd "$1"

folders=()
for folder in sim fit apps; do
  [[ -d $folder ]] && folders+=("$folder")
done
if [[ ${#folders[@]} -eq 0 ]]; then
  echo "no sources under $1" >&2
  exit 2
fi

check_sources() {
  # shellcheck disable=SC2016  # the dollars are awk's
  find "${folders[@]}" -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.inc' \) -print0 | sort -z |
    xargs -0 --no-run-if-empty awk '
    # From right to left in "apps -> apps/commands -> apps/preview -> apps/output -> apps/options -> fit -> sim/render -> sim/emit, sim/view -> sim/light -> sim/scene -> sim/base".
    function layer(path) {
      if (path ~ /^sim\/render\//) return "sim/render"
      if (match(path, /^sim\/(base|scene|light|emit|view)\//)) return substr(path, 1, RLENGTH - 1)
      if (match(path, /^apps\/(options|output|preview|commands)\//)) return substr(path, 1, RLENGTH - 1)
      if (path ~ /^apps\/[^\/]*$/) return "apps"
      if (path ~ /^fit\//) return "fit"
      return ""
    }
    function complain(text) { print FILENAME ":" FNR ": " text; bad = 1 }
    function exists(path, line, status) {
      status = (getline line < path)
      close(path)
      return status >= 0
    }
    BEGIN {
      rank["sim/base"] = 0; rank["sim/scene"] = 1; rank["sim/light"] = 2; rank["sim/emit"] = 3; rank["sim/view"] = 3
      rank["sim/render"] = 4; rank["fit"] = 5
      rank["apps/options"] = 6; rank["apps/output"] = 7; rank["apps/preview"] = 8; rank["apps/commands"] = 9; rank["apps"] = 10
    }
    FNR == 1 {
      from = layer(FILENAME)
      if (from == "") complain("belongs to no layer of the house")
      folder = FILENAME
      sub(/[^\/]*$/, "", folder)
      of_apps = from ~ /^apps/
      library = !of_apps
      # What volumes are made of is read in these and handed on.
      reads_volumes = FILENAME ~ /^sim\/render\/volumes\/(depth_file|volume_files)\.cpp$/
      physics = from ~ /^sim\/(light|emit|view|render)$/ && !reads_volumes
    }
    { code = $0; sub(/\/\/.*/, "", code) }
    code ~ /^[ \t]*#[ \t]*include[ \t]*[<"]/ {
      target = code
      sub(/^[ \t]*#[ \t]*include[ \t]*[<"]/, "", target)
      sub(/[>"].*/, "", target)

      # Rule 1: includes run one way, by paths from the root.
      if (target ~ /(^|\/)\.\.?\//) complain("include by a path from the root, not " target)
      else if (target ~ /^(sim|fit|apps)\//) {
        to = layer(target)
        if (to == "") complain(target " belongs to no layer of the house")
        else if (from != "" && (rank[to] > rank[from] || (rank[to] == rank[from] && to != from)))
          complain(from " must not include " to " (" target ")")
      }
      else if (target ~ /^tests\//) complain("what is shipped must not include tests (" target ")")
      else if (code ~ /"/ && exists(folder target)) complain("include by a path from the root, not " target)

      # Rule 2: each large library has its place.
      if (target ~ /^ceres\// && from != "fit") complain("Ceres belongs in fit/ only")
      if (target ~ /^opencv2?\// && !(from == "fit" && FILENAME ~ /\.cpp$/)) {
        if (!of_apps) complain("OpenCV belongs in the .cpp files of fit/")
        else if (FILENAME == "apps/preview/preview_window.cpp") {}
        else if (videos == "") videos = FILENAME
        else if (videos != FILENAME) complain("OpenCV is in " videos " already: one file of apps/ may have it, and preview_window.cpp")
      }
      if (target ~ /^CLI\// && FILENAME != "apps/options/command.cpp")
        complain("CLI11 belongs in apps/options/command.cpp only")
      if (target ~ /^OpenImageIO\// && folder != "sim/base/picture/image_io/")
        complain("OpenImageIO belongs in sim/base/picture/image_io/ only")
      if (target ~ /^fitsio/ && FILENAME != "sim/base/picture/fits_io.cpp")
        complain("CFITSIO belongs in sim/base/picture/fits_io.cpp only")
      if (target ~ /^openvdb\// && FILENAME !~ /^sim\/base\/grid\/vdb_(io|read).cpp$/)
        complain("OpenVDB belongs in sim/base/grid/vdb_io.cpp and vdb_read.cpp only")
      if (target ~ /^toml(\+\+)?[\/.]/ && from != "sim/scene") complain("TOML parsing belongs in sim/scene only")
      if (target ~ /^muParser/ && FILENAME != "sim/scene/freedom/expression.cpp")
        complain("muParser belongs in sim/scene/freedom/expression.cpp only")

      # Rule 6: libraries do not print, physics does no input or output.
      if (library && target ~ /^(iostream|print|syncstream)$/) complain("libraries do not print (<" target ">)")
      if (physics && (target ~ /^(fstream|filesystem)$/ || target ~ /^sim\/base\/(picture\/(image_io|fits_io)|grid\/(vdb_io|vdb_outline)|file\/whole_)/))
        complain("physics does no input or output (" target ")")
    }
    library && code ~ /std::(cout|cerr|clog|wcout|wcerr)|(^|[^A-Za-z0-9_])(v?f?printf|f?puts|putchar|fmt::print)[ \t]*\(/ {
      complain("libraries do not print")
    }
    END { exit bad }'
}

check_names() {
  local found
  found=$(find . \( -path ./.git -o -path ./build -o -path ./runs \) -prune -o -print |
    grep -Ei '(^|[/_])(utils?|helpers?|misc)(\.[^/]*)?$' || true)
  if [[ -n $found ]]; then
    printf '%s\n' "$found" "Names of files and folders say what is inside."
    return 1
  fi
}

check_paths() {
  local found
  # Text files only; what comes before the slash must not make it part of a longer path or an address.
  found=$(grep -rnIE '(^|[^[:alnum:]_.~/-])/(home|root|work|Users|tmp|mnt)/[[:alnum:]_.]' . \
    --exclude=.git --exclude-dir=.git --exclude-dir=build --exclude-dir=runs || true)
  if [[ -n $found ]]; then
    printf '%s\n' "$found" "Paths of one machine do not belong here."
    return 1
  fi
}

status=0
check_sources || status=1
check_names || status=1
check_paths || status=1
exit "$status"
