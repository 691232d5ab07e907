#!/usr/bin/env bash
# Does include_direction_test.sh find what it is there to find? A clean tree must pass; each violation, added alone, must
# be reported under its own file.
# usage: include_direction_self_check.sh
set -euo pipefail
checker=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/include_direction_test.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tree=$folder/tree
clean=$folder/clean
failures=0

put() {
  [[ -d $tree/${1%/*} ]] || mkdir -p "$tree/${1%/*}"
  printf '%s\n' "$2" >"$tree/$1"
}

make_tree() {
  put sim/base/image.h '#include <vector>'
  put sim/base/picture/image_io/openimageio_module.cpp '#include <OpenImageIO/imageio.h>'
  put sim/base/picture/fits_io.cpp '#include <fitsio.h>'
  put sim/base/grid/openvdb_module.cpp '#include <openvdb/openvdb.h>'
  put sim/base/grid/vdb_io.cpp '#include <openvdb/version.h>'
  put sim/base/file/whole_file.h '#include <string>  // not <iostream>, no std::cout, no printf()'
  put sim/scene/file/scene_toml.cpp '#include <toml++/toml.h>'
  put fit/survey/survey_toml.cpp '#include <toml++/toml.h>'
  put sim/scene/freedom/expression.cpp '#include <muParser.h>'
  put sim/light/field.h '#include "sim/scene/structs/scene.h"'
  put sim/emit/aurora/beam.h '#include "sim/light/field.h"'
  put sim/view/film/film.cpp $'#include "hwy/highway.h"\n#include "sim/view/camera/camera.h"\nstd::snprintf(text, 9, "%g", x);'
  put sim/render/render.cpp $'#include "sim/emit/aurora/beam.h"\n#include "sim/view/film/film.h"\n#include "sim/render/beams/kernel.h"'
  put fit/photo/photo.cpp $'#include <opencv2/imgproc.hpp>\n#include <ceres/ceres.h>\n#include "sim/render/render.h"'
  put apps/vegard.cpp $'#include <iostream>\n#include "fit/photo/photo.h"'
  put apps/options/command.cpp '#include <CLI/CLI.hpp>'
  put apps/preview/preview_window_module.cpp '#include <opencv2/highgui.hpp>'
  put apps/output/animation/movie_module.cpp '#include <opencv2/videoio.hpp>'
  put tests/fit/photo/photo_test.cpp '#include "fit/photo/photo.h"'
  put docs/readme.md 'See https://example.org/home/page and ~/work/mine.'
}

# A copy: made anew, file by file, it would take most of the time of this script.
clean_tree() {
  rm -rf "${tree:?}"
  cp -r "$clean" "$tree"
}

accepts() {
  if ! "$checker" "$tree" >"$tree.log" 2>&1; then
    echo "a clean tree is refused:"
    cat "$tree.log"
    failures=$((failures + 1))
  fi
  rm -f "$tree.log"
}

# refuses FILE CONTENT [NAME]: added to the tree as it is, which is clean afterwards; the report must hold NAME, the
# file's own if not given
refuses() {
  put "$1" "$2"
  if "$checker" "$tree" >"$tree.log" 2>&1; then
    echo "not found: $1: $2"
    failures=$((failures + 1))
  elif [[ $(<"$tree.log") != *"${3:-$1}"* ]]; then
    echo "found, but not under its name: $1: $2"
    cat "$tree.log"
    failures=$((failures + 1))
  fi
  rm -f "$tree.log"
  clean_tree
}

make_tree
cp -r "$tree" "$clean"
accepts

# What git does not track is passed over: a log of a build may name paths of the machine.
git -C "$tree" init --quiet
git -C "$tree" add --all
put ./build.log "built in $tree"
put fit/bad.cpp '#include "apps/vegard.h"'
accepts
git -C "$tree" add fit/bad.cpp
refuses fit/bad.cpp '#include "apps/vegard.h"'

# Rule 1.
refuses sim/base/bad.h '#include "sim/scene/structs/scene.h"'
refuses sim/base/bad.h '  #  include <sim/scene/structs/scene.h>'
refuses sim/scene/table/bad.h '#include "sim/light/field.h"'
refuses sim/light/bad.h '#include "sim/view/film/film.h"'
refuses sim/emit/aurora/bad.h '#include "sim/view/film/film.h"'
refuses sim/view/film/bad.cpp '#include "sim/emit/grid/grid_bricks.h"'
refuses sim/emit/grid/bad.cpp '#include "sim/emit/footprint/foot.h"'
refuses fit/measure/bad.h '#include "fit/search/search.h"'
refuses fit/search/bad.h '#include "fit/fit.h"'
refuses sim/scene/structs/bad.h '#include "sim/scene/table/parameter_table.h"'
refuses sim/view/film/bad.cpp '#include "sim/render/render.h"'
refuses sim/render/bad.cpp '#include "fit/photo/photo.h"'
refuses fit/bad.cpp '#include "apps/vegard.h"'
refuses sim/base/bad.h '#include "image.h"'
refuses sim/view/bad.h '#include "../base/image.h"'
refuses sim/elsewhere/bad.h '#include <vector>'
refuses sim/view/bad.h '#include <vector>'
refuses tests/fit/elsewhere/bad_test.cpp ''
refuses fit/bad.cpp '#include "tests/support/temporary_folder.h"'

# Rule 2.
refuses sim/render/render.cpp '#include <ceres/jet.h>'
refuses apps/bad.cpp '#include <ceres/ceres.h>'
refuses fit/bad.cpp '#include <pybind11/pybind11.h>'
refuses fit/bad.cpp '#include "python/arrays.h"'
refuses sim/view/film/bad.cpp '#include <opencv2/imgproc.hpp>'
refuses fit/bad.h '#include <opencv2/core.hpp>'
refuses fit/photo/bad.cpp '#include <jpeglib.h>'
refuses fit/photo/bad.cpp '#include <png.h>'
refuses fit/photo/bad.cpp '#include <zlib.h>'
refuses apps/xbad.cpp '#include <opencv2/core.hpp>'
refuses fit/photo/photo.cpp '#include <opencv2/imgcodecs.hpp>'
refuses apps/preview/preview_loop.cpp '#include <opencv2/highgui.hpp>'
refuses apps/preview/preview_window.h '#include <opencv2/highgui.hpp>'
refuses apps/commands/bad.cpp '#include <CLI/CLI.hpp>'
refuses sim/base/bad.cpp '#include <OpenImageIO/imageio.h>'
refuses sim/base/image_io.cpp '#include <OpenImageIO/imageio.h>'
refuses sim/base/picture/image_io/exr.cpp '#include <OpenImageIO/imageio.h>'
refuses fit/bad.cpp '#include <OpenImageIO/imagebuf.h>'
refuses sim/base/bad.cpp '#include <fitsio.h>'
refuses fit/fits_io.cpp '#include <fitsio.h>'
refuses sim/base/bad.cpp '#include <openvdb/openvdb.h>'
refuses sim/base/grid/vdb_io.cpp '#include <openvdb/openvdb.h>'
refuses sim/render/volumes/vdb_io.cpp '#include <openvdb/io/File.h>'
refuses fit/bad.cpp '#include <toml++/toml.h>'
refuses fit/survey/bad.cpp '#include <sqlite3.h>'
refuses sim/base/file/bad.cpp '#include <hdf5.h>'
refuses fit/photo/bad.cpp '#include <lcms2.h>'
refuses fit/photo/frames/bad.cpp '#include <libavformat/avformat.h>'
refuses sim/base/array/bad.cpp '#include <matio.h>'
refuses fit/photo/bad.cpp '#include <archive.h>'
refuses sim/base/bad.cpp '#include <boost/iostreams/filtering_stream.hpp>'
refuses fit/survey/bad.cpp '#include <netcdf.h>'
refuses fit/survey/bad.cpp '#include "sim/scene/table/toml_value.h"'
refuses sim/base/bad.cpp '#include <toml.hpp>'
refuses sim/scene/table/bad.cpp '#include <muParser.h>'
refuses fit/bad.cpp '#include <muParserError.h>'

# Rule 6.
refuses sim/base/bad.cpp '#include <iostream>'
refuses fit/bad.cpp 'std::cerr << x;'
refuses fit/bad.cpp '  printf("%d", x);'
refuses sim/view/film/bad.cpp 'std::fprintf(stderr, "x");'
refuses sim/view/film/bad.cpp 'fmt::print("x");'
refuses sim/view/film/bad.cpp '#include <fstream>'
refuses sim/emit/aurora/bad.cpp '#include "sim/base/file/whole_file.h"'
refuses sim/view/film/bad.cpp '#include "sim/base/picture/fits_io.h"'

# Names and paths.
refuses sim/base/utils.h ''
refuses fit/helpers/bad.h '' fit/helpers
refuses fit/string_utils.cpp ''

# Knots run through a header and its source file alike.
put fit/measure/one.h ''
put fit/measure/one.cpp '#include "fit/measure/two.h"'
put fit/measure/two.h ''
refuses fit/measure/two.cpp '#include "fit/measure/one.h"' fit/measure/one

# A folder that is too full.
for ((i = 0; i < 40; ++i)); do put "fit/measure/bin_$i.h" ''; done
accepts
refuses fit/measure/bin_40.h '' 'fit/measure: 41'

slash=/
refuses docs/bad.md "run ${slash}home/someone/vegard"
refuses scripts/bad.sh "cd ${slash}root/vegard"

if [[ $failures -gt 0 ]]; then
  echo "$failures of the self-checks failed"
  exit 1
fi
