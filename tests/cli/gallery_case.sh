# The gallery's scenes render, each with light in it, small and with few beams.
source "$(dirname "$0")/case.sh"
gallery=$SOURCE/data/gallery
count=0
for scene in "$gallery"/*.toml; do
  few=()
  while read -r name; do few+=(--set "sheet.$name.beams_per_km=4"); done < <(awk '/^\[/ { sheet = /^\[\[sheet\]\]/ } sheet && /^name = / { gsub(/"/, ""); print $3 }' "$scene")
  height=64
  ! grep -q '^model = "equirectangular"' "$scene" || height=48
  expect_exit 0 render "$scene" -o "$(basename "$scene" .toml).png" --set camera.width=96 --set camera.height=$height \
    --set camera.focal_px=30 "${few[@]}"
  line=557.7  # of nebulae, of the Sun, of other bodies and of STEVE any
  ! grep -Eq '^\[\[nebula\]\]|^\[sun\]|^\[body\]|^form = "steve"' "$scene" || line='[0-9.]*'
  peak=$(grep -o "[0-9]* R at $line nm" "$stdout" | cut -d' ' -f1 | sort -n | tail -1)
  [[ $peak -gt 300 ]] || fail "$scene: the peak is only $peak R"
  count=$((count + 1))
done
[[ $count -ge 28 ]] || fail "only $count scenes in $gallery"
