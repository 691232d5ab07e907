# The gallery's scenes render, each with light in it, small and with few beams.
source "$(dirname "$0")/case.sh"
gallery=$SOURCE/data/gallery
count=0
for scene in "$gallery"/*.toml; do
  few=()
  while read -r name; do few+=(--set "sheet.$name.beams_per_km=4"); done < <(sed -n 's/^name = "\(.*\)"/\1/p' "$scene")
  expect_exit 0 render "$scene" -o "$(basename "$scene" .toml).png" --set camera.width=96 --set camera.height=64 \
    --set camera.focal_px=30 "${few[@]}"
  peak=$(sed -n 's/.* \([0-9]*\) R at 557.7 nm.*/\1/p' "$stdout")
  [[ $peak -gt 300 ]] || fail "$scene: the green line's peak is only $peak R"
  count=$((count + 1))
done
[[ $count -ge 10 ]] || fail "only $count scenes in $gallery"
