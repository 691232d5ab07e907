# vegard params: the listing, the page, and how it refuses.
source "$(dirname "$0")/case.sh"

# expect_exit CODE PART COMMAND...: the exit code, and one line "vegard: …PART…" on the error stream.
expect_exit() {
  local code=$1 part=$2 got=0
  shift 2
  "$@" > "$stdout" 2> "$stderr" || got=$?
  [ "$got" = "$code" ] || fail "$* gave $got, not $code: $(cat "$stderr")"
  [ "$code" = 0 ] && return
  [ "$(wc -l < "$stderr")" = 1 ] || fail "$*: more than one line: $(cat "$stderr")"
  grep -q "^vegard: " "$stderr" || fail "$*: $(cat "$stderr")"
  grep -qF -- "$part" "$stderr" || fail "$*: no '$part' in: $(cat "$stderr")"
}

expect_exit 0 "" "$VEGARD" params
grep -q '^sheet\.<name>\.energy_kev  *3\.0  *keV  *0\.1 to 20  *can be  *characteristic energy' "$stdout" ||
  fail "the listing lacks the energy"
grep -q '^sheet\.<name>\.start_km ' "$stdout" || fail "the listing lacks the alternative forms"

"$VEGARD" params --markdown > parameters.md
diff -u "$SOURCE/docs/parameters.md" parameters.md ||
  fail "docs/parameters.md is out of date: vegard params --markdown > docs/parameters.md"

expect_exit 0 "" "$VEGARD" params --forms
diff -u "$SOURCE/docs/forms.md" "$stdout" || fail "docs/forms.md is out of date: vegard params --forms > docs/forms.md"

cat > scene.toml <<'SCENE'
[[sheet]]
name = "arc"
energy_kev = 4.25
[fit]
free = ["sheet.arc.energy_kev"]
SCENE
expect_exit 0 "" "$VEGARD" params scene.toml
grep -q '^sheet\.arc\.energy_kev  *4\.25  *keV  *0\.1 to 20  *yes ' "$stdout" || fail "no value of the scene"
grep -q '^blur\.width_deg\.5577  *0\.18 ' "$stdout" || fail "no component by its line"

cat > tied.toml <<'SCENE'
[[sheet]]
[fit]
free = ["sheet.main.width_km", { name = "t", start = 2, min = 1, max = 9 }]
tied = [{ path = "sheet.main.thickness_km", equals = "t + sheet.width_km" }]
SCENE
expect_exit 0 "" "$VEGARD" params tied.toml
grep -q '^sheet\.main\.width_km .* yes ' "$stdout" || fail "a free parameter is not listed as free"
grep -q '^sheet\.main\.thickness_km .* tied ' "$stdout" || fail "a tied parameter is not listed as tied"
sed -i 's/t + sheet/t + shet/' tied.toml
expect_exit 2 "tied.toml:4: sheet.main.thickness_km: the expression has an unknown name, 'shet.width_km'" "$VEGARD" \
  params tied.toml

echo 'sede = 1' > bad.toml
expect_exit 2 "bad.toml:1: sede: unknown key 'sede'; did you mean 'seed'?" "$VEGARD" params bad.toml
expect_exit 3 "there is no such file" "$VEGARD" params missing.toml
expect_exit 3 "is a directory" "$VEGARD" params .
expect_exit 2 "SCENE excludes --markdown" "$VEGARD" params scene.toml --markdown
expect_exit 2 "excludes" "$VEGARD" params scene.toml --forms
expect_exit 2 "--loud" "$VEGARD" params --loud
expect_exit 2 "parms" "$VEGARD" parms
expect_exit 2 "which subcommand" "$VEGARD"
if [ -w /dev/full ]; then
  got=0
  "$VEGARD" params > /dev/full 2> "$stderr" || got=$?
  [ "$got" = 6 ] || fail "a full disk gave $got"
fi

expect_exit 0 "" "$VEGARD" --version
for name in vegard Ceres OpenCV Eigen; do
  grep -q "^$name [0-9][0-9.]*" "$stdout" || fail "--version lacks $name"
done
