#!/usr/bin/env bash
# A scene of the Sun beside the same grid in Blender's Cycles: how far the pictures differ, and what they take.
# docs/corona.md has the numbers. Compared is the light of what the grid holds, in the first line of the scene, before
# a black ball in the photosphere's place.
# usage: scripts/compare_corona_with_cycles.sh VEGARD GRID_BENCH [SCENE.toml] [VOXEL] [SCALE]
#   SCALE of the picture, of the scene's: a half if not given, for Cycles takes minutes
# Exit code 77: there is no blender.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
vegard=$(realpath "$1") bench=$(realpath "$2")
scene=$(realpath "${3:-$here/../data/gallery/solar_corona.toml}") voxel=${4:-0.5} scale=${5:-0.5}
# shellcheck source=scripts/cycles.sh
source "$here/cycles.sh"
command -v blender >/dev/null || { echo "there is no blender: skipped"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
frames=3  # of which the first loads what there is

value() { awk -v table="[$1]" -v key="$2" '/^\[/ { here = $1 == table } here && $1 == key { print $3; exit }' "$scene"; }
width=$(awk "BEGIN { print int($scale * $(value camera width)) }")
height=$(awk "BEGIN { print int($scale * $(value camera height)) }")
line=$(awk '/^lines = \[/ { gsub(/[][,]/, " "); print $3 }' "$scene")
distance=$(awk "BEGIN { printf \"%.9g\", $(value sun distance_km) / $(value sun unit_km) }")
loops=$(awk '/^\[/ { here = $1 == "[[loop]]" } here && $1 == "name" { gsub(/"/, "", $3); print $3 }' \
  "$scene" | paste -sd,)
"$vegard" volume "$scene" --of "$loops" --lines "$line" --voxel "$voxel" -o loops.vdb
cat >grid.toml <<EOF
$(awk '/^\[/ { here = $1 == "[site]" || $1 == "[camera]" || $1 == "[sun]" } 
     here && $1 == "width" { print "width = " width; next } here && $1 == "height" { print "height = " height; next }
     here && $1 != "photosphere_rayleigh"' width="$width" height="$height" "$scene")
[emission]
lines = [$line]
[blur]
width_deg = [0.0]
[[volume]]
name = "loops"
file = "loops.vdb"
frame = "sun"
step_voxels = 1.0
EOF
grid_by_cycles() {
  local out=$1
  shift
  cycles "$PWD/loops.vdb" "$PWD/$out" grid="emission_$(awk "BEGIN { print $line * 10 }")" width="$width" \
    height="$height" hfov_deg="$(value camera hfov_deg)" azimuth_deg="$(value camera azimuth_deg)" \
    elevation_deg="$(value camera elevation_deg)" step_km="$voxel" sun_azimuth_deg="$(value sun azimuth_deg)" \
    sun_elevation_deg="$(value sun elevation_deg)" sun_distance="$distance" ball="$(value sun radius)" \
    rayleigh_per_unit="$(awk "BEGIN { print $(value sun unit_km) * 0.1 }")" "$@"
}

echo "Agreement, one ray through the middle of each pixel, steps of a voxel (Cycles against vegard):"
grid_by_cycles middle.exr subpixels=1 repeat=$frames >cycles_s
"$bench" march grid.toml --repeat 1 -o one.exr >/dev/null
"$bench" difference middle.exr one.exr
"$bench" march grid.toml --threads 2 --repeat 7 | awk '{ print $2 }' >vegard_s
theirs=$(median <cycles_s) ours=$(median <vegard_s)
echo "Time of the grid, two threads, $width x $height: Cycles $theirs s, vegard $ours s (medians):" \
  "$(awk "BEGIN { printf \"%.1f\", $theirs / $ours }") times"
echo -n "The whole scene by vegard, from its file to a picture, without any grid: "
TIMEFORMAT="%R s"
time "$vegard" render "$scene" --threads 2 -o scene.png >/dev/null
