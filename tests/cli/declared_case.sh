# What files declare about their light, their frame and their units is applied or refused: made files of each kind
# (a quarter of them; cli.declared_whole takes all), and the small inputs of shared/cases where they are.
source "$(dirname "$0")/case.sh"
python3 "$(dirname "$0")/declared_cases.py" "$VEGARD" "$SOURCE" >"$stdout" 2>"$stderr" || {
  cat "$stdout"
  fail "what a file declares is not what is read"
}
cat "$stdout"
