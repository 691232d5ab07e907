#!/usr/bin/env bash
# The rules of the house that can be read off the sources (docs/architecture.md, rules 1, 2 and 6).
# usage: include_direction_test.sh ROOT
# Looks at the files that git tracks below ROOT; where ROOT is no checkout (an unpacked archive), at all of them.
# Prints one line per violation; exit code 1 if there is any.
set -euo pipefail
rooms=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/rooms.txt
cd "$1"

tracked() {
  if [[ "$(git rev-parse --show-cdup 2>/dev/null || echo none)" == "" ]]; then
    git ls-files --cached
  else
    find . -type f -not -path './build/*' -not -path './runs/*' | sed 's|^\./||'
  fi | sort | while read -r file; do
    if [[ -f $file ]]; then echo "$file"; fi # not what is deleted and not yet committed
  done
}
mapfile -t files < <(tracked)
mapfile -t sources < <(printf '%s\n' "${files[@]}" | grep -E '^(sim|fit|apps|python)/.*\.(h|cpp|inc)$' || true)
if [[ ${#sources[@]} -eq 0 ]]; then
  echo "no sources under $1" >&2
  exit 2
fi

# shellcheck disable=SC2016  # the dollars of the programs below are awk's

check_sources() {
  awk '
    # The folder of a file; the top of the house that it belongs to.
    function room_of(path) { sub(/\/[^\/]*$/, "", path); return path }
    function top_of(path) {
      if (match(path, /^sim\/(base|scene|light|emit|view|render)\//)) return substr(path, 1, RLENGTH - 1)
      if (match(path, /^(fit|apps|python)\//)) return substr(path, 1, RLENGTH - 1)
      return ""
    }
    function stem_of(path) { sub(/\.[^.\/]*$/, "", path); return path }
    function complain(text) { print FILENAME ":" FNR ": " text; bad = 1 }
    function exists(path, line, status) {
      status = (getline line < path)
      close(path)
      return status >= 0
    }
    # Whether one stem leads to another by the edges that are left.
    function reaches(start, goal, queue, seen, first, last, i) {
      split("", queue); split("", seen)
      queue[last = 1] = start
      for (first = 1; first <= last; ++first) {
        if (queue[first] == goal) return 1
        for (i = 1; i <= edges; ++i)
          if ((i in edge_from) && edge_from[i] == queue[first] && !seen[edge_to[i]]++) queue[++last] = edge_to[i]
      }
      return 0
    }
    FILENAME == ARGV[1] {
      if ($0 !~ /^#/ && NF > 0) { ++ranks; for (i = 1; i <= NF; ++i) rank[$i] = ranks }
      next
    }
    FNR == 1 {
      from = top_of(FILENAME)
      room = room_of(FILENAME)
      if (!(room in rank)) complain("belongs to no room of the house (tests/house/rooms.txt)")
      else ++inhabitants[room]
      folder = room "/"
      library = from != "apps"
      # What volumes are made of is read in these and handed on.
      reads_volumes = FILENAME ~ /^sim\/render\/emitters\/volume_files\.cpp$/
      physics = from ~ /^sim\/(light|emit|view|render)$/ && !reads_volumes
    }
    { code = $0; sub(/\/\/.*/, "", code) }
    code ~ /^[ \t]*#[ \t]*include[ \t]*[<"]/ {
      target = code
      sub(/^[ \t]*#[ \t]*include[ \t]*[<"]/, "", target)
      sub(/[>"].*/, "", target)

      # Rule 1: includes run one way, by paths from the root.
      if (target ~ /(^|\/)\.\.?\//) complain("include by a path from the root, not " target)
      else if (target ~ /^(sim|fit|apps|python)\//) {
        to = room_of(target)
        if (!(to in rank)) complain(target " belongs to no room of the house")
        else if ((room in rank) && (rank[to] > rank[room] || (rank[to] == rank[room] && to != room)))
          complain(room " must not include " to " (" target ")")
        else if ((from == "sim/emit" && top_of(target) == "sim/view") || (from == "sim/view" && top_of(target) == "sim/emit"))
          complain(from " and " top_of(target) " do not know each other (" target ")")
        if (stem_of(FILENAME) != stem_of(target)) {
          ++edges
          edge_from[edges] = stem_of(FILENAME)
          edge_to[edges] = stem_of(target)
        }
      }
      else if (target ~ /^tests\//) complain("what is shipped must not include tests (" target ")")
      else if (code ~ /"/ && exists(folder target)) complain("include by a path from the root, not " target)

      # Rule 2: each large library has its place.
      if (target ~ /^ceres\// && from != "fit") complain("Ceres belongs in fit/ only")
      if (target ~ /^opencv2?\// && !(from == "fit" && FILENAME ~ /\.cpp$/)) {
        if (FILENAME !~ /^apps\/(output\/animation\/movie|preview\/preview_window)_module\.cpp$/)
          complain("OpenCV belongs in the .cpp files of fit/, apps/output/animation/movie_module.cpp and apps/preview/preview_window_module.cpp")
      }
      if (target ~ /^opencv2\/(imgcodecs|videoio|highgui)/ && FILENAME !~ /(_module|^fit\/photo\/codec\/decode_opencv)\.cpp$/)
        complain("what makes every start slow (" target ") belongs in a module, sim/base/module.h")
      if (target ~ /^(pybind11\/|Python\.h)/ && room != "python") complain("Python belongs in python/ only")
      if (target ~ /^CLI\// && room != "apps/options") complain("CLI11 belongs in apps/options/ only")
      if (target ~ /^httplib/ && FILENAME != "apps/studio/studio_server.cpp")
        complain("cpp-httplib belongs in apps/studio/studio_server.cpp only")
      if (target ~ /^OpenEXR\// && FILENAME != "sim/base/picture/image_io/openexr_module.cpp")
        complain("OpenEXR belongs in sim/base/picture/image_io/openexr_module.cpp only")
      if (target ~ /^OpenImageIO\// && FILENAME != "sim/base/picture/image_io/openimageio_module.cpp" && !(target ~ /oiioversion/ && FILENAME == "sim/base/picture/image_io/library.cpp"))
        complain("OpenImageIO belongs in sim/base/picture/image_io/openimageio_module.cpp only")
      if (target ~ /^jpeglib/ && FILENAME !~ /^(fit\/photo\/codec\/jpeg_rows|sim\/base\/picture\/image_io\/jpeg)\.cpp$/)
        complain("libjpeg belongs in fit/photo/codec/jpeg_rows.cpp and sim/base/picture/image_io/jpeg.cpp only")
      if (target ~ /^png\.h/ && FILENAME !~ /^sim\/base\/picture\/(image_io\/png|png_pixels)\.cpp$/)
        complain("libpng belongs in sim/base/picture/image_io/png.cpp and png_pixels.cpp only")
      if (target ~ /^lib(av|sw)/ && FILENAME !~ /^(fit\/photo\/frames\/video|apps\/output\/animation\/movie)_module\.cpp$/)
        complain("FFmpeg belongs in fit/photo/frames/video_module.cpp and apps/output/animation/movie_module.cpp only")
      if (target ~ /^lcms2/ && FILENAME != "fit/photo/codec/icc_profile.cpp")
        complain("LittleCMS belongs in fit/photo/codec/icc_profile.cpp only")
      if (target ~ /^zlib/ && FILENAME != "sim/base/file/byte_stream.cpp")
        complain("zlib belongs in sim/base/file/byte_stream.cpp only")
      if (target ~ /^fitsio/ && FILENAME != "sim/base/picture/fits_io.cpp")
        complain("CFITSIO belongs in sim/base/picture/fits_io.cpp only")
      if (target ~ /^openvdb\// && FILENAME != "sim/base/grid/openvdb_module.cpp" && !(target ~ /\/version\.h$/ && FILENAME == "sim/base/grid/vdb_io.cpp"))
        complain("OpenVDB belongs in sim/base/grid/openvdb_module.cpp only")
      if (target ~ /^(toml(\+\+)?[\/.]|sim\/scene\/table\/(bounded_toml|checked_table|toml_value)\.h)/ && from != "sim/scene" && FILENAME != "fit/survey/survey_toml.cpp" && FILENAME != "fit/photo/rayleigh/rayleigh_camera.cpp")
        complain("TOML parsing belongs in sim/scene, fit/survey/survey_toml.cpp and fit/photo/rayleigh/rayleigh_camera.cpp only")
      if (target ~ /^sqlite3/ && FILENAME != "fit/survey/sqlite_file.cpp")
        complain("SQLite belongs in fit/survey/sqlite_file.cpp only")
      if (target ~ /^netcdf/ && FILENAME != "sim/base/file/netcdf_file.cpp")
        complain("netCDF belongs in sim/base/file/netcdf_file.cpp only")
      if (target ~ /^muParser/ && FILENAME != "sim/scene/freedom/expression.cpp")
        complain("muParser belongs in sim/scene/freedom/expression.cpp only")
      if (target ~ /^hdf5/ && FILENAME != "sim/base/array/hdf5_file.cpp")
        complain("HDF5 belongs in sim/base/array/hdf5_file.cpp only")
      if (target ~ /^matio/ && FILENAME != "sim/base/array/mat_file.cpp")
        complain("libmatio belongs in sim/base/array/mat_file.cpp only")
      if (target ~ /^archive(_entry)?\.h/ && FILENAME != "sim/base/file/tar_file.cpp")
        complain("libarchive belongs in sim/base/file/tar_file.cpp only")
      if (target ~ /^boost\// && FILENAME != "fit/photo/camera_bodies.cpp")
        complain("Boost belongs in fit/photo/camera_bodies.cpp only")

      # Rule 6: libraries do not print, physics does no input or output.
      if (library && target ~ /^(iostream|print|syncstream)$/) complain("libraries do not print (<" target ">)")
      if (physics && (target ~ /^(fstream|filesystem)$/ || target ~ /^sim\/base\/(picture\/(image_io|fits_io)|grid\/(vdb_io|vdb_outline|openvdb)|file\/whole_)/))
        complain("physics does no input or output (" target ")")
    }
    library && code ~ /std::(cout|cerr|clog|wcout|wcerr)|(^|[^A-Za-z0-9_])(v?f?printf|f?puts|putchar|fmt::print)[ \t]*\(/ {
      complain("libraries do not print")
    }
    END {
      # Knots: what is left of the graph of stems (a .h and its .cpp together) when those that include nothing
      # of the rest, or are included by nothing of it, have been taken away again and again.
      do {
        changed = 0
        split("", uses); split("", used)
        for (i = 1; i <= edges; ++i) if (i in edge_from) { uses[edge_from[i]] = 1; used[edge_to[i]] = 1 }
        for (i = 1; i <= edges; ++i)
          if ((i in edge_from) && (!(edge_to[i] in uses) || !(edge_from[i] in used))) { delete edge_from[i]; changed = 1 }
      } while (changed)
      for (i = 1; i <= edges; ++i)
        if ((i in edge_from) && !said[edge_from[i] SUBSEP edge_to[i]]++ && reaches(edge_to[i], edge_from[i])) {
          print edge_from[i] ": includes " edge_to[i] ", which leads back to it: a knot"
          bad = 1
        }
      for (room in inhabitants)
        if (inhabitants[room] > 40) { print room ": " inhabitants[room] " files in one folder, at most 40"; bad = 1 }
      exit bad
    }' "$rooms" "${sources[@]}"
}

# The tests mirror the rooms; and no folder of theirs is crowded.
check_tests() {
  printf '%s\n' "${files[@]}" | awk '
    FILENAME == ARGV[1] { if ($0 !~ /^#/) for (i = 1; i <= NF; ++i) room[$i] = 1; next }
    !/^tests\/.*\.(h|cpp)$/ { next }
    {
      folder = $0
      sub(/\/[^\/]*$/, "", folder)
      if (++inhabitants[folder] == 41) { print folder ": more than 40 files in one folder"; bad = 1 }
      mirrored = folder
      sub(/^tests\//, "", mirrored)
      if (mirrored ~ /^(sim|fit|apps)(\/|$)/ && !(mirrored in room)) { print $0 ": tests no room of the house"; bad = 1 }
    }
    END { exit bad }' "$rooms" -
}

check_names() {
  local found
  found=$(printf '%s\n' "${files[@]}" | grep -Ei '(^|[/_])(utils?|helpers?|misc)([./][^/]*)*$' || true)
  if [[ -n $found ]]; then
    printf '%s\n' "$found" "Names of files and folders say what is inside."
    return 1
  fi
}

check_paths() {
  local found
  # Text files only; what comes before the slash must not make it part of a longer path or an address.
  found=$(printf '%s\0' "${files[@]}" |
    xargs -0 grep -nIE '(^|[^[:alnum:]_.~/-])/(home|root|work|Users|tmp|mnt)/[[:alnum:]_.]' /dev/null || true)
  if [[ -n $found ]]; then
    printf '%s\n' "$found" "Paths of one machine do not belong here."
    return 1
  fi
}

status=0
check_sources || status=1
check_tests || status=1
check_names || status=1
check_paths || status=1
exit "$status"
