#!/usr/bin/env bash
# Renders the scenes of data/gallery into docs/pictures/gallery: the pictures of docs/gallery.md.
# usage: scripts/make_gallery.sh [SCENE ...]   (names without .toml; eye: eye.jpg, which needs ImageMagick's montage; default: all)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
vegard=build/release/vegard
pictures=docs/pictures/gallery
mkdir -p "$pictures"
scenes=("$@")
with_eye=no
if [[ ${#scenes[@]} -eq 0 || ${scenes[*]} == eye ]]; then
  with_eye=yes
  [[ ${#scenes[@]} -eq 0 ]] || scenes=(-)
fi
if [[ ${#scenes[@]} -eq 0 ]]; then
  for scene in data/gallery/*.toml; do
    name=$(basename "$scene" .toml)
    [[ $name == dance ]] || scenes+=("$name")  # that one is for vegard animate
  done
fi
for name in "${scenes[@]}"; do
  [[ $name != - ]] || continue
  "$vegard" render "data/gallery/$name.toml" -o "$pictures/$name.jpg" --quality 88 --overwrite
done

# The drapery with a brightest spot of 1, 10, 100 and 1000 kR: above by a camera exposed for it, below to the eye.
if [[ $with_eye == yes ]]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  for kilorayleigh in 1 10 100 1000; do
    # The brightest spot has 0.14 of what one layer has along the field.
    seen=(data/gallery/drapery.toml
      --set "sheet.curtain.brightness_kilorayleigh=$(awk "BEGIN { print 7.15 * $kilorayleigh }")"
      --set camera.width=480 --set camera.height=216 --set camera.elevation_deg=53 --set stars.shown=false
      --set 'sky.level=[0,0,0]' --set 'sky.gradient=[0,0,0]' --set composite.foreground=)
    "$vegard" render "${seen[@]}" -o "$folder/camera$kilorayleigh.png" \
      --set "sensor.gain_per_kilorayleigh=$(awk "BEGIN { print 0.9 / $kilorayleigh }")"
    "$vegard" render "${seen[@]}" -o "$folder/eye$kilorayleigh.png" --as-seen
  done
  montage "$folder"/camera{1,10,100,1000}.png "$folder"/eye{1,10,100,1000}.png -tile 4x2 -geometry +4+4 \
    -background black -quality 88 "$pictures/eye.jpg"
fi
