# shellcheck shell=bash
# What every case needs; to be sourced by a script that was called with the binary and the source folder.
# The case then runs in an empty folder of its own, which is gone at its end.
set -euo pipefail

VEGARD=$1
SOURCE=$2
SCENES=$SOURCE/tests/cli/scenes

folder=$(mktemp -d "${TMPDIR:-/tmp}/vegard-cli-XXXXXX")
trap 'rm -rf "$folder"' EXIT
cd "$folder"
stdout=$folder/.stdout
stderr=$folder/.stderr

fail() {
  echo "FAILED: $*" >&2
  echo "--- its output:" >&2
  cat "$stdout" >&2
  echo "--- its messages:" >&2
  cat "$stderr" >&2
  exit 1
}

# expect_exit CODE ARGUMENTS...: runs vegard; its output is kept for the other questions.
expect_exit() {
  local expected=$1 status=0
  shift
  "$VEGARD" "$@" >"$stdout" 2>"$stderr" || status=$?
  [[ $status -eq $expected ]] || fail "exit $status instead of $expected: vegard $*"
}

# says FILE FACTS: one line of the file has all the facts, fixed strings with " | " between them. What is asked for are numbers,
# keys and names, so that sentences can be bettered.
says() {
  facts=$2 awk 'BEGIN { number = split(ENVIRON["facts"], fact, / \| /) }
    { for (i = 1; i <= number; i++) if (!index($0, fact[i])) next; found = 1; exit }
    END { exit !found }' "$1"
}

# expect_stderr FACTS, expect_stdout FACTS: the last run said this.
expect_stderr() { says "$stderr" "$1" || fail "no '$1' in the messages"; }
expect_stdout() { says "$stdout" "$1" || fail "no '$1' in the output"; }

# expect_one_message: an error is told in one line.
expect_one_message() { [[ $(wc -l <"$stderr") -eq 1 ]] || fail "not one line of message"; }

expect_file() { [[ -s $1 ]] || fail "$1 is missing or empty"; }
expect_same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
expect_different() { ! cmp -s "$1" "$2" || fail "$1 and $2 are the same"; }

# expect_starts FILE HEX: the file's first bytes, by which its format is known.
expect_starts() {
  local found
  found=$(head -c $((${#2} / 2)) "$1" | od -An -v -tx1 | tr -d ' \n')
  [[ $found == "$2" ]] || fail "$1 begins with $found instead of $2"
}

# expect_only NAMES...: nothing else is in the folder, hidden files included.
expect_only() {
  local found wanted
  found=$(find . -mindepth 1 -maxdepth 1 ! -name .stdout ! -name .stderr -printf '%f\n' | LC_ALL=C sort)
  wanted=$([[ $# -eq 0 ]] || printf '%s\n' "$@" | LC_ALL=C sort)
  [[ $found == "$wanted" ]] || fail "the folder holds: $found; expected: $wanted"
}

# scene_with SED_COMMAND: the small scene, changed, as scene.toml.
scene_with() {
  sed "$1" "$SCENES/small.toml" >scene.toml
  ! cmp -s scene.toml "$SCENES/small.toml" || fail "'$1' changes nothing"
}

# interrupt JOB: Ctrl-C once it listens and has said something, or at once what has ended; $status is its exit code.
interrupt() {
  wait_until_interruptible "$1"
  for _ in $(seq 3000); do
    [[ ! -s $stderr && -e /proc/$1 ]] || break
    sleep 0.01
  done
  kill -INT "$1" 2>/dev/null || true
  status=0
  wait "$1" || status=$?
}

# wait_until_interruptible JOB: until the program listens for Ctrl-C, however busy the machine is.
wait_until_interruptible() {
  local caught
  for _ in $(seq 3000); do
    # Until it runs our program, a job is a copy of the shell, which listens for Ctrl-C in its own way, but not for
    # SIGTERM; and what it listens for is still told for a moment when the program is already there.
    caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null) || caught=
    [[ -n $caught && /proc/$1/exe -ef $VEGARD ]] && (((0x${caught: -4} & 0x4002) == 0x4002)) && return 0
    sleep 0.02
  done
  fail "the program never listens for Ctrl-C"
}

# wait_until_worked JOB HUNDREDTHS: until the job has had so much of the processor's time, or has ended.
wait_until_worked() {
  local had
  while had=$(awk '{ sub(/.*\) /, ""); print $12 + $13 }' "/proc/$1/stat" 2>/dev/null) && [[ -n $had && $had -lt $2 ]]; do
    sleep 0.01
  done
}
