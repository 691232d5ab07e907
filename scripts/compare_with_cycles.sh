#!/usr/bin/env bash
# The same grid of light, seen by the same camera, by Blender's Cycles and by vegard: how far the pictures differ, and
# what they take. docs/openvdb.md has the numbers.
# usage: scripts/compare_with_cycles.sh VEGARD GRID_BENCH [--quick]
#   VEGARD is the command, GRID_BENCH the program of tests/bench. --quick: a smaller picture, agreement only; fails
#   if the pictures differ by more than 2 %.
# Exit code 77: there is no blender.
#
# Times are those of the rendering alone. Cycles: every frame but the first, with persistent data, so that nothing is
# loaded; from "Sample 0" to the last sample in what Blender prints (hundredths of a second). vegard: the march, on a
# grid that has been read. Both on two threads, in turns, medians of all.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
vegard=$(realpath "$1") bench=$(realpath "$2") quick=${3:-}
# shellcheck source=scripts/cycles.sh
source "$here/cycles.sh"
command -v blender >/dev/null || { echo "there is no blender: skipped"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
width=640 height=480 voxel=0.5 beams=4000 rounds=3 frames=6
[[ $quick == --quick ]] && width=160 height=120 voxel=2 beams=400 rounds=1 frames=1

common="seed = 11
[site]
latitude_deg = 65.0
[field]
inclination_deg = 78.0
[camera]
width = $width
height = $height
hfov_deg = 60.0
azimuth_deg = 10.0
elevation_deg = 32.0
[emission]
lines = [557.7]
[blur]
width_deg = [0.0]"
cat >sheet.toml <<EOF
$common
[[sheet]]
name = "main"
center_km = [20.0, 200.0]
bearing_deg = 86.0
length_km = 330.0
thickness_km = 5.0
wavelength_km = 64.0
phase_rad = 2.0
phase_shift_rad = 0.9
layers = 3
width_km = 2.0
beams = $beams
energy_kev = 3.0
energy_flux_mw_m2 = 5.0
EOF
cat >grid.toml <<EOF
$common
[[volume]]
name = "sheet"
file = "sheet.vdb"
step_voxels = 1.0
EOF
"$vegard" volume sheet.toml -o sheet.vdb --voxel-km "$voxel"

sheet_by_cycles() {
  local out=$1
  shift
  cycles "$PWD/sheet.vdb" "$PWD/$out" width=$width height=$height hfov_deg=60 azimuth_deg=10 elevation_deg=32 \
    step_km="$voxel" "$@"
}

echo "Agreement, one ray through the middle of each pixel, steps of a voxel (Cycles against vegard):"
sheet_by_cycles middle.exr subpixels=1 >/dev/null
"$bench" march grid.toml --repeat 1 -o one.exr >/dev/null
"$bench" difference middle.exr one.exr | tee agreement
awk '{ for (i = 1; i < NF; ++i) value[$i] = $(i + 1) }
     END { exit !(value["total"] > 0.98 && value["total"] < 1.02 && value["rms_of_peak"] < 0.02 &&
                  value["mean_relative_where_bright"] < 0.02) }' agreement || { echo "they differ by more than 2 %"; exit 1; }
[[ $quick == --quick ]] && exit 0

echo "Error against sixteen rays to a pixel, of each its own:"
sheet_by_cycles many.exr subpixels=4 samples=16 seed=100 >/dev/null
"$bench" march grid.toml --repeat 1 --rays 4 -o sixteen.exr >/dev/null
: >cycles_s
: >vegard_s
for _ in $(seq $rounds); do
  sheet_by_cycles one_sample.exr subpixels=4 repeat=$frames >>cycles_s
  "$bench" march grid.toml --threads 2 --repeat 15 | awk '{ print $2 }' >>vegard_s
done
echo -n "Cycles, one sample, anywhere in the pixel:  "
"$bench" difference one_sample.exr many.exr
echo -n "Cycles, one sample, in the pixel's middle:  "
"$bench" difference middle.exr many.exr
echo -n "vegard, one ray, in the pixel's middle:     "
"$bench" difference one.exr sixteen.exr
theirs=$(median <cycles_s) ours=$(median <vegard_s)
echo "Time, two threads, ${width} x ${height}: Cycles $theirs s (median of $(wc -l <cycles_s)), vegard $ours s (median of" \
  "medians): $(awk "BEGIN { printf \"%.1f\", $theirs / $ours }") times"
