# Lines of the user's own, and scenes on another body than the Earth.
source "$(dirname "$0")/case.sh"

cat > proton.toml <<'SCENE'
[camera]
width = 60
height = 40
[[line]]
name = "h_beta"
wavelength_nm = 486.1
follows_nm = 427.8
ratio = 0.05
[emission]
lines = [427.8, 486.1]
[[sheet]]
beams = 200
SCENE
expect_exit 0 render proton.toml -o proton.png --lines proton.exr
[[ ! -s $stderr ]] || ! grep -q h_beta "$stderr" || fail "a line that shines is told to be inert"
peak() { grep -o "[0-9.]* R at $1 nm" "$stdout" | cut -d' ' -f1; }
violet=$(peak 427.8) blue=$(peak 486.1)
awk -v a="$violet" -v b="$blue" 'BEGIN { exit !(a > 500 && b > 0.049 * a && b < 0.051 * a) }' ||
  fail "486.1 nm has $blue R beside $violet R of 427.8 nm"
expect_exit 0 brightness proton.toml
expect_stdout 486.1

# One that nothing makes shine is told, and rendered; one that nobody has is refused.
sed 's/^follows_nm.*//; s/^ratio.*//' proton.toml > dark.toml
expect_exit 0 render dark.toml -o dark.png
expect_stderr "line.h_beta.wavelength_nm: | nothing"
sed 's/486.1\]/486.1, 500]/' proton.toml > unknown.toml
expect_exit 2 render unknown.toml -o unknown.png
expect_one_message
expect_stderr "500 nm"

expect_exit 0 bodies
expect_stdout "jupiter: radius 69911 km"
expect_stdout " 656.3 nm  h_alpha "

cat > jupiter.toml <<'SCENE'
[body]
name = "jupiter"
[camera]
width = 60
height = 40
[emission]
lines = [656.3]
[[sheet]]
beams = 200
profile = "layer"
top_km = 640
SCENE
expect_exit 0 render jupiter.toml -o jupiter.png
[[ $(peak 656.3 | cut -d. -f1) -gt 100 ]] || fail "Jupiter is dark"
expect_exit 2 render jupiter.toml -o refused.png --set sheet.profile=maxwellian
expect_one_message
expect_stderr "Earth alone"
expect_exit 2 render jupiter.toml -o refused.png --set sheet.profile=proton --set emission.lines=[486.1] --set sheet.line_nm=486.1
expect_one_message
expect_stderr "sheet.main.profile"
[[ ! -e refused.png ]] || fail "a picture was written"
expect_exit 2 fit jupiter.toml --photo jupiter.png --out run --set fit.free='["sheet.main.energy_flux_mw_m2"]'
expect_one_message
expect_stderr "a fit | Earth"
