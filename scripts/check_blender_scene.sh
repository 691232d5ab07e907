#!/usr/bin/env bash
# That scripts/blender_scene.py sets up what vegard sees: a sequence of two grids by a turned camera with a shifted
# axis, before a sky, beside the same scene of vegard's; and that it refuses what it cannot use.
# usage: scripts/check_blender_scene.sh VEGARD GRID_BENCH
# Exit code 77: there is no blender.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
vegard=$(realpath "$1") bench=$(realpath "$2")
command -v blender >/dev/null || { echo "there is no blender: skipped"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >sheet.toml <<'EOF'
seed = 11
[site]
latitude_deg = 65.0
[camera]
width = 160
height = 120
hfov_deg = 50.0
azimuth_deg = 15.0
elevation_deg = 35.0
roll_deg = 12.0
principal_x_px = 14.0
principal_y_px = -9.0
[emission]
lines = [557.7]
[blur]
width_deg = [0.0]
[[sheet]]
name = "main"
center_km = [20.0, 200.0]
bearing_deg = 86.0
length_km = 330.0
layers = 2
width_km = 2.0
beams = 400
drift_km_s = [0.0, 8.0]
EOF
"$vegard" volume sheet.toml -o light_0001.vdb --voxel-km 2
"$vegard" volume sheet.toml -o light_0002.vdb --voxel-km 2 --set time.start_s=10
{ sed '/^\[\[sheet/,$d' sheet.toml; printf '[[volume]]\nname = "sheet"\nfile = "light_0001.vdb"\nstep_voxels = 1.0\n'; } >grid.toml
"$bench" march grid.toml --repeat 1 -o vegard.exr >/dev/null
set_up() { blender -b -t 2 --python "$here/blender_scene.py" -- "$@" >log 2>&1; }
set_up sheet.toml scene.blend light_000{1,2}.vdb grid=emission_5577 step_km=2 samples=16 render=blender.exr ||
  { cat log; exit 1; }
"$bench" difference blender.exr vegard.exr | tee agreement
# Blender samples the whole pixel, vegard its middle.
awk '{ for (i = 1; i < NF; ++i) value[$i] = $(i + 1) }
     END { exit !(value["total"] > 0.98 && value["total"] < 1.02 && value["rms_of_peak"] < 0.03) }' agreement ||
  { echo "they differ"; exit 1; }
blender -b scene.blend --python-expr 'import bpy
light = bpy.data.volumes[0]
assert light.is_sequence and light.frame_duration == 2 and light.frame_offset == 0, "no sequence"
assert bpy.context.scene.frame_end == 2 and bpy.context.scene.camera.data.clip_end > 1e5
print("as", "expected")' >log 2>&1
grep -q "as expected" log || { cat log; exit 1; }

# refuse WORDS ARGUMENT...: one message and exit 2
refuse() {
  local words=$1 code=0
  shift
  set_up "$@" || code=$?
  if [[ $code -ne 2 ]] || ! grep -q "blender_scene.py: .*$words" log; then
    cat log
    echo "exit $code, not 2 with '$words'"
    exit 1
  fi
}
refuse "no file 'none.vdb'" sheet.toml scene.blend none.vdb
refuse "no grid 'red'" sheet.toml scene.blend light_0001.vdb grid=red
refuse "no key 'colour'" sheet.toml scene.blend light_0001.vdb colour=1
refuse "numbered" sheet.toml scene.blend light_0002.vdb light_0001.vdb
mkdir other
cp light_0001.vdb light.vdb
cp light_0002.vdb other
cp light_0002.vdb night_0002.vdb
refuse "'light.vdb' is not" sheet.toml scene.blend light.vdb light_0001.vdb
refuse "not 'night_0002.vdb'" sheet.toml scene.blend light_0001.vdb night_0002.vdb
refuse "not 'other/light_0002.vdb'" sheet.toml scene.blend light_0001.vdb other/light_0002.vdb
sed 's/^roll_deg.*/model = "stereographic"/' sheet.toml >fisheye.toml
refuse "no lens" fisheye.toml scene.blend light_0001.vdb
sed 's/^roll_deg.*/mirrored = true/' sheet.toml >mirrored.toml
refuse "mirrored" mirrored.toml scene.blend light_0001.vdb
sed 's/^roll_deg.*/aspect = 1.1/' sheet.toml >aspect.toml
refuse "aspect" aspect.toml scene.blend light_0001.vdb
sed 's/^roll_deg.*/model = "equidistant"/' sheet.toml >fisheye.toml
refuse "pinholes alone" fisheye.toml scene.blend light_0001.vdb
sed -i '/^principal/d' fisheye.toml
refuse "stretches" fisheye.toml scene.blend light_0001.vdb
