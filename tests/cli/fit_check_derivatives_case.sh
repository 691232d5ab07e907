# The derivative doctor: a table, exit 0 if all agree, 5 if a parameter has no effect; no run is written.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --check-derivatives
expect_stdout "All derivatives"
[[ $(grep -cE '^sheet\.main\..* agree$' "$stdout") -eq 2 ]] || fail "not two parameters that agree"
# Where the flux changes the brightness alone, the gains take it up entirely.
sed 's/^free = .*/free = ["sheet.main.energy_kev", "sheet.main.energy_flux_mw_m2"]/' "$SCENES/fit.toml" >flux.toml
expect_exit 5 fit flux.toml --photo photo.png --check-derivatives --set 'emission.flux_law="linear"'
grep -qE '^sheet\.main\.energy_flux_mw_m2 .* no effect$' "$stdout" || fail "the flux has an effect"
expect_stdout "1 of 2"
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png
expect_stderr "--out"
expect_only photo.png flux.toml
