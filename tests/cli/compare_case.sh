# One photograph, two scenes: the table, the words, the exit code; runs of different data are refused.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out right
# Electrons that are held at twice their energy: one parameter less, and a model that misses something.
sed -e 's/^free = .*/free = ["sheet.main.center_km.north"]/' -e 's/^energy_kev = .*/energy_kev = 6.0/' "$SCENES/fit.toml" >held.toml
expect_exit 5 fit held.toml --photo photo.png --out held
expect_exit 0 compare right held/
expect_stdout "right | better than held | BIC"
expect_stdout "very strong evidence"
for text in "AIC" "BIC" "chi2/dof" "independent" "sheet.main.energy_kev"; do expect_stdout "$text"; done
row=$(grep -E '^right ' "$stdout" | head -1)
[[ $row =~ \ 0\.0\ +good$ ]] || fail "the better run is not its own reference: $row"
# The order of the runs changes the order of the lines alone.
grep -oE 'BIC lower by .*' "$stdout" >one
expect_exit 0 compare held right
diff one <(grep -oE 'BIC lower by .*' "$stdout") >&2 || fail "the order of the runs matters"
# Compared with itself: nothing to choose; and its own verdict counts.
expect_exit 5 compare held held
expect_stdout "not worth more than a bare mention"
expect_stdout "Doubtful"
# Another photograph, other weights, other values.
expect_exit 0 render "$SCENES/small.toml" -o other.png --seed 8
expect_exit 0 fit "$SCENES/fit.toml" --photo other.png --out other
expect_exit 2 compare right other
expect_stderr "another photograph"
expect_one_message
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out weights --set fit.model_error=0.011
expect_exit 2 compare right weights
expect_stderr "fit.model_error"
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out bands --set fit.bands=5
expect_exit 2 compare right bands
expect_stderr "fit.bands"
expect_exit 4 fit "$SCENES/fit.toml" --photo photo.png --out short --max-evaluations 1
expect_exit 4 compare right short
expect_stdout "Do not believe it"
expect_exit 2 compare right
expect_exit 3 compare right nothing
mkdir empty
echo '{}' >empty/result.json
expect_exit 3 compare right empty
