#!/usr/bin/env bash
# Renders the scenes of data/gallery into docs/pictures/gallery: the pictures of docs/gallery.md.
# usage: scripts/make_gallery.sh [SCENE ...]   (names without .toml, or photographs; default: all)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
vegard=build/release/vegard
pictures=docs/pictures/gallery
mkdir -p "$pictures"
scenes=("$@")
if [[ ${#scenes[@]} -eq 0 ]]; then
  for scene in data/gallery/*.toml; do
    name=$(basename "$scene" .toml)
    [[ $name == dance ]] || scenes+=("$name")  # that one is for vegard animate
  done
fi
for name in "${scenes[@]}"; do
  [[ $name == photographs ]] && continue  # below
  "$vegard" render "data/gallery/$name.toml" -o "$pictures/$name.jpg" --quality 88 --overwrite
done

# The drapery as photographs: one light, many electrons and few.
if [[ $# -eq 0 || " $* " == *" photographs "* ]]; then
  camera=(--set 'sensor.exposure="camera"' --set sensor.f_number=1.8 --set sensor.vignetting_cos_power=2.5
    --set 'sky.level=[0.02, 0.03, 0.05]' --set camera.width=640 --set camera.height=427 --photograph --quality 88 --overwrite)
  "$vegard" render data/gallery/drapery.toml "${camera[@]}" --set time.exposure_s=0.5 --set sensor.iso=51200 \
    -o "$pictures/photograph_short.jpg"
  "$vegard" render data/gallery/drapery.toml "${camera[@]}" --set time.exposure_s=16 --set sensor.iso=1600 \
    -o "$pictures/photograph_long.jpg"
fi
