#!/usr/bin/env bash
# Renders the scenes of data/gallery into docs/pictures/gallery: the pictures of docs/gallery.md.
# usage: scripts/make_gallery.sh [SCENE ...]   (names without .toml; default: all)
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
  "$vegard" render "data/gallery/$name.toml" -o "$pictures/$name.jpg" --quality 88 --overwrite
done
