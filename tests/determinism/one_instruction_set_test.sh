#!/usr/bin/env bash
# The command with vector code for this machine's processor alone writes the same bytes as the one for all processors: pictures that
# go through each file with vector code (a pinhole, a lens, footprints, grids, the lit ground, the blur), and a fit, by derivatives.
# usage: one_instruction_set_test.sh VEGARD VEGARD_OF_ONE_SET SOURCE_FOLDER
set -euo pipefail
all=$1 one=$2 source=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

write() { # FOLDER BINARY
  local status=0 small=(--set camera.width=96 --set camera.height=64)
  mkdir "$1"
  cd "$1"
  ln -s "$2" vegard # what is written names the command as it was called
  ./vegard render "$source/tests/cli/scenes/small.toml" -o pinhole.png
  ./vegard render "$source/tests/cli/scenes/small.toml" -o pinhole.exr
  ./vegard render "$source/data/gallery/all_sky.toml" -o lens.exr --set camera.width=96 --set camera.height=96 --set camera.focal_px=32
  ./vegard render "$source/data/gallery/footprint_bands.toml" -o footprints.exr "${small[@]}" --set camera.focal_px=52
  ./vegard render "$source/data/gallery/moonlit_snow.toml" -o ground.exr "${small[@]}"
  ./vegard render "$source/data/gallery/sun_heating.toml" -o grids.exr "${small[@]}"
  ./vegard fit "$source/tests/cli/scenes/fit.toml" --photo pinhole.png --out run || status=$?
  [[ $status -eq 0 ]]
  cd ..
}

write all "$all" >all.log 2>&1 || { cat all.log >&2; exit 1; }
write one "$one" >one.log 2>&1 || { cat one.log >&2; exit 1; }
rm all/vegard one/vegard
[[ $(find all -type f | wc -l) -ge 12 ]] || { echo "too few files to compare" >&2; exit 1; }
diff -r all one
