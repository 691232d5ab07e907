#!/usr/bin/env bash
# Renders data/gallery/solar_corona.toml in stages, as its source shows them, into docs/pictures/corona.
# usage: scripts/make_corona_stages.sh [STAGE ...]   (granules, cutoff, biasmap, curve, falloff, filters, final; default: all)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
vegard=build/release/vegard
scene=data/gallery/solar_corona.toml
pictures=docs/pictures/corona
mkdir -p "$pictures"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp data/gallery/solar_corona_bias.png "$folder"

# part OUT NAME...: the scene with those of its [[tables]] only that have one of the names
part() {
  local out=$1
  shift
  awk -v names=" $* " '
    function flush() { if (keep) printf "%s", held; held = "" }
    /^\[/ { flush(); keep = $1 !~ /^\[\[/ }
    { held = held $0 "\n" }
    $1 == "name" { name = $3; gsub(/"/, "", name); if (index(names, " " name " ")) keep = 1 }
    BEGIN { keep = 1 }
    END { flush() }' "$scene" >"$folder/$out"
}
# draw PICTURE SCENE [path=value ...], at half the size
draw() {
  local picture=$1 from=$2 settings=()
  shift 2
  for setting in camera.width=410 camera.height=345 stars.shown=false "$@"; do settings+=(--set "$setting"); done
  "$vegard" render "$folder/$from" "${settings[@]}" --quality 88 --overwrite -o "$pictures/$picture.jpg"
}

stages=("$@")
[[ ${#stages[@]} -gt 0 ]] || stages=(granules cutoff biasmap curve falloff filters final)
part surface.toml clouds
part loop.toml arcade
# Light alone, before a dark ball, as the source shows its noise.
bare=(chromosphere.clouds.extinction=0 'sun.photosphere_rayleigh=[0, 0, 0]' 'chromosphere.clouds.rayleigh=[4e3, 1.6e3, 2e2]'
  chromosphere.clouds.peak=0)
low=(camera.elevation_deg=44)
near=(camera.hfov_deg=17 camera.azimuth_deg=182 camera.elevation_deg=56.5)
for stage in "${stages[@]}"; do
  case $stage in
    granules)
      draw granules_medium surface.toml "${low[@]}" "${bare[@]}" chromosphere.clouds.cutoff=false
      draw granules_large surface.toml "${low[@]}" "${bare[@]}" chromosphere.clouds.cutoff=false chromosphere.clouds.scale=44
      draw granules_small surface.toml "${low[@]}" "${bare[@]}" chromosphere.clouds.cutoff=false chromosphere.clouds.scale=11
      ;;
    cutoff)
      draw cutoff_without surface.toml "${low[@]}" chromosphere.clouds.cutoff=false chromosphere.clouds.peak=0
      draw cutoff_with surface.toml "${low[@]}" chromosphere.clouds.peak=0
      ;;
    biasmap)
      draw biasmap_without surface.toml "${low[@]}" chromosphere.clouds.peak=0
      draw biasmap_with surface.toml "${low[@]}"
      ;;
    curve)
      draw curve_one loop.toml "${near[@]}" loop.arcade.strands=1 loop.arcade.strand_radius=2.5 loop.arcade.root_noise=0 loop.arcade.tilt_noise_deg=0 \
        loop.arcade.density_noise=0 loop.arcade.base_density=4
      draw curve_strands loop.toml "${near[@]}" loop.arcade.filaments=0
      draw curve_filaments loop.toml "${near[@]}"
      ;;
    falloff)
      draw falloff_grow loop.toml "${near[@]}" 'loop.arcade.height_falloff="grow"' loop.arcade.falloff_least=0 loop.arcade.brightening=0
      draw falloff_fade loop.toml "${near[@]}" 'loop.arcade.height_falloff="fade"' loop.arcade.falloff_least=0 loop.arcade.brightening=0
      ;;
    filters)
      draw filters_before loop.toml "${near[@]}" loop.arcade.voxel=0.7
      draw filters_blur loop.toml "${near[@]}" loop.arcade.voxel=0.7 loop.arcade.blur=2
      draw filters_sharpen loop.toml "${near[@]}" loop.arcade.voxel=0.7 loop.arcade.blur=2 loop.arcade.sharpen=2
      ;;
    final) "$vegard" render "$scene" --quality 90 --overwrite -o "$pictures/final.jpg" ;;
    *) echo "there is no stage '$stage'" >&2; exit 2 ;;
  esac
done
