#!/usr/bin/env bash
# Code knows parameters by their identity, role and row, never by their key: in the search and what it rests on no key and
# no path of the table stands in a string where it could be compared (sim/scene/table/parameter_id.h has roles); in
# sim/scene no key is compared, since what holds for one parameter stands in its row (sim/scene/rows/row.h).
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
# Of all rows.
# shellcheck disable=SC2016  # the dollars are awk's
all_keys=$(files_in sim/scene/rows sim/scene/emitters | xargs --no-run-if-empty awk '
  match($0, /"[a-z0-9_]+", *&[A-Za-z]+::/) { key = substr($0, RSTART + 1); sub(/".*/, "", key); print key }' | sort -u)
if [[ -z $keys ]]; then
  echo "no rows of parameters that may be free under $1" >&2
  exit 2
fi

bad=0

# violations KEYS RULE FILES...: strings that are a key, or a path that ends in one, and stand where RULE says that they
# are compared; sentences for the user that name one are none.
violations() {
  local keys=$1 rule=$2
  shift 2
  # shellcheck disable=SC2016  # the dollars are awk's
  awk -v keys="$keys" -v rule="$rule" '
  BEGIN {
    split(keys, list, "\n")
    for (i in list) is_key[list[i]] = 1
  }
  {
    code = $0
    sub(/^[ \t]*#.*/, "", code)
    is_search = code ~ /std::set<std::string>|is_one_of\(|\.(compare|rfind)\(/
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
  # Beside == or !=, or handed to a function that may compare it; in sim/scene, whose rows and messages hand keys on, to
  # one that searches for it.
  function compares(before, after) {
    return before ~ /[=!]=[ \t]*$/ || after ~ /^[ \t]*[=!]=/ ||
      (before ~ /[(,{][ \t]*$/ && (rule == "handed" || is_search))
  }
  END { exit bad }' "$@"
}

mapfile -t search < <(files_in fit/search fit/parameters)
[[ ${#search[@]} -eq 0 ]] || violations "$keys" handed "${search[@]}" || bad=1

# Exceptions: decoding_word.cpp reads the value of fit.decoding, of which "gamma" is a word and also a key of [sensor].
mapfile -t scene < <(files_in sim/scene | grep -v '^sim/scene/rows/decoding_word\.cpp$')
violations "$all_keys" searched "${scene[@]}" || bad=1
exit $bad
