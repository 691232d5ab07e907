#!/usr/bin/env bash
# Renders the scenes of data/gallery into docs/pictures/gallery: the pictures of docs/gallery.md.
# usage: scripts/make_gallery.sh [NAME ...]   (scenes without .toml, photographs; eye and flight, which need ImageMagick's montage; default: all)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
vegard=build/release/vegard
pictures=docs/pictures/gallery
mkdir -p "$pictures"
names=("$@")
if [[ ${#names[@]} -eq 0 ]]; then
  for scene in data/gallery/*.toml; do
    name=$(basename "$scene" .toml)
    [[ $name == dance || $name == flight ]] || names+=("$name")  # those are for vegard animate
  done
  names+=(photographs eye flight)
fi

# The drapery as photographs: one light, many electrons and few.
make_photographs() {
  local camera=(--set 'sensor.exposure="camera"' --set sensor.f_number=1.8 --set sensor.vignetting_cos_power=2.5
    --set 'sky.level=[0.02, 0.03, 0.05]' --set camera.width=640 --set camera.height=427 --photograph --quality 88 --overwrite
    --set 'sensor.tone="srgb"')
  "$vegard" render data/gallery/drapery.toml "${camera[@]}" --set time.exposure_s=0.5 --set sensor.iso=51200 \
    -o "$pictures/photograph_short.jpg"
  "$vegard" render data/gallery/drapery.toml "${camera[@]}" --set time.exposure_s=16 --set sensor.iso=1600 \
    -o "$pictures/photograph_long.jpg"
}

# The drapery with a brightest spot of 1, 10, 100 and 1000 kR: above by a camera exposed for it, below to the eye.
make_eye() {
  local kilorayleigh seen
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT  # the folder outlives this function
  for kilorayleigh in 1 10 100 1000; do
    # The brightest spot has 0.235 of what one layer has along the field.
    seen=(data/gallery/drapery.toml
      --set "sheet.curtain.brightness_kilorayleigh=$(awk "BEGIN { print 4.255 * $kilorayleigh }")"
      --set camera.width=480 --set camera.height=216 --set camera.elevation_deg=50 --set stars.shown=false
      --set 'sky.level=[0,0,0]' --set 'sky.gradient=[0,0,0]' --set composite.foreground=)
    "$vegard" render "${seen[@]}" -o "$folder/camera$kilorayleigh.png" --set 'sensor.tone="srgb"' \
      --set "sensor.gain_per_kilorayleigh=$(awk "BEGIN { print 0.9 / $kilorayleigh }")"
    "$vegard" render "${seen[@]}" -o "$folder/eye$kilorayleigh.png" --as-seen
  done
  montage "$folder"/camera{1,10,100,1000}.png "$folder"/eye{1,10,100,1000}.png -tile 4x2 -geometry +4+4 \
    -background black -quality 88 "$pictures/eye.jpg"
}

# Six instants of the flight.
make_flight() {
  local second
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  for second in 0 6 9 12 15 20; do
    "$vegard" render data/gallery/flight.toml -o "$folder/$(printf %02d $second).png" --set "time.start_s=$second" \
      --set camera.width=480 --set camera.height=270
  done
  montage "$folder"/*.png -tile 3x2 -geometry +4+4 -background black -quality 88 "$pictures/flight.jpg"
}

for name in "${names[@]}"; do
  case $name in
    photographs) make_photographs ;;
    eye) make_eye ;;
    flight) make_flight ;;
    *) "$vegard" render "data/gallery/$name.toml" -o "$pictures/$name.jpg" --quality 88 --overwrite ;;
  esac
done
