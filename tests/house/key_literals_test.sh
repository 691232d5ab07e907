#!/usr/bin/env bash
# The search and what it rests on know parameters by their identity and role (sim/scene/table/parameter_id.h): no key
# and no path of the table stands in a string of theirs, where it could be compared.
# usage: key_literals_test.sh ROOT
# Prints one line per violation; exit code 1 if there is any.
set -euo pipefail
cd "$1"

# In a repository its tracked files alone; else (an unpacked archive) what is there.
files_in() {
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files -- "$@"
  else
    find "$@" -type f
  fi | grep -E '\.(h|cpp)$' || true
}

# Of rows that may be free, which are all that a search has: row("key", &Type::member)...may_be_free(...).
# shellcheck disable=SC2016  # the dollars are awk's
keys=$(files_in sim/scene/rows sim/scene/emitters | xargs --no-run-if-empty awk '
  match($0, /"[a-z0-9_]+", *&[A-Za-z]+::/) { key = substr($0, RSTART + 1); sub(/".*/, "", key) }
  /may_be_free\(/ { if (key != "") print key; key = "" }' | sort -u)
if [[ -z $keys ]]; then
  echo "no rows of parameters that may be free under $1" >&2
  exit 2
fi

# Strings that are a key, or a path that ends in one; sentences for the user that name one are none.
# shellcheck disable=SC2016  # the dollars are awk's
files_in fit/search fit/parameters | xargs --no-run-if-empty awk -v keys="$keys" '
  BEGIN {
    split(keys, list, "\n")
    for (i in list) is_key[list[i]] = 1
  }
  {
    code = $0
    sub(/^[ \t]*#.*/, "", code)
    while (match(code, /"([^"\\]|\\.)*"/)) {
      before = substr(code, 1, RSTART - 1)
      text = substr(code, RSTART + 1, RLENGTH - 2)
      code = substr(code, RSTART + RLENGTH)
      if (before ~ /\/\//) break
      key = text
      sub(/.*\./, "", key)
      if (key in is_key && compares(before, code)) {
        print FILENAME ":" FNR ": compared with a key of the table: \"" text "\""
        bad = 1
      }
    }
  }
  # Beside == or !=, or handed to a function that may compare it.
  function compares(before, after) {
    return before ~ /[=!]=[ \t]*$/ || after ~ /^[ \t]*[=!]=/ || before ~ /[(,{][ \t]*$/
  }
  END { exit bad }'
