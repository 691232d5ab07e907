# The habits that all subcommands share: --json, --quiet, colours on a terminal alone, exit codes in every help.
source "$(dirname "$0")/case.sh"
python3 "$SOURCE/tests/cli/terminal_habits.py" "$VEGARD" "$SOURCE" >"$stdout" 2>"$stderr" || fail "a habit is broken"
