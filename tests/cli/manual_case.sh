# Manual pages and completions come of the same words as --help; a shell completes by them.
source "$(dirname "$0")/case.sh"
expect_exit 0 manual -o share
for page in vegard vegard-fit vegard-render vegard-survey vegard-survey-run vegard-invert; do expect_file share/man/man1/$page.1; done
expect_exit 2 manual -o share
expect_one_message
expect_exit 0 manual -o share --overwrite
# All of them or none, nor an empty folder: one file is in the way, the last of all.
mkdir -p other/zsh/vendor-completions
echo mine >other/zsh/vendor-completions/_vegard
expect_exit 2 manual -o other
expect_one_message
[[ $(find other | wc -l) == 4 && $(cat other/zsh/vendor-completions/_vegard) == mine ]] || fail "left: $(find other | tr '\n' ' ')"
expect_exit 0 manual -o other --overwrite
[[ $(find other -type f | wc -l) == $(find share -type f | wc -l) ]] || fail "not all of them are written"
# Every subcommand of the help has its page, and every long option of a subcommand stands on it.
expect_exit 0 --help
mapfile -t commands < <(sed -n '/^From a photograph/,/^Exit codes/s/^  \([a-z][a-z-]*\).*/\1/p' "$stdout")
((${#commands[@]} > 25)) || fail "the help has ${#commands[@]} subcommands"
for command in "${commands[@]}"; do
  expect_file "share/man/man1/vegard-$command.1"
  "$VEGARD" "$command" --help >help.txt
  missing=$(LC_ALL=C comm -23 <(sed -nE 's/^  (-[a-zA-Z],)?(--[a-z][a-z0-9-]*).*/\2/p' help.txt | LC_ALL=C sort -u) \
    <(grep -oE '\\fB\\-\\-[a-z0-9\-]*\\fR' "share/man/man1/vegard-$command.1" | sed 's/\\fB//; s/\\fR//; s/\\//g' | LC_ALL=C sort -u))
  [[ -z $missing ]] || fail "$command: ${missing//$'\n'/ } is not on its page"
done
# The pages are sound: no warning of groff's, where it is installed.
if command -v groff >/dev/null; then
  for page in share/man/man1/*.1; do
    groff -man -Tutf8 -ww -z "$page" >groff.txt 2>&1 || true
    [[ ! -s groff.txt ]] || fail "$page: $(head -3 groff.txt)"
  done
fi

# What bash completes: subcommands, their options, the words that an option takes, and no option where a file is meant.
complete_in_bash() {  # WORDS...: the last is the one that is typed
  bash -c 'source share/bash-completion/completions/vegard
    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _vegard; printf "%s\n" "${COMPREPLY[@]}"' bash vegard "$@"
}
completes() {  # WANTED WORDS...
  local found  # whole, before grep ends: a pipe that is closed early is an error too
  found=$(complete_in_bash "${@:2}")
  grep -qxF -- "$1" <<<"$found" || fail "bash does not complete ${*:2} to $1: ${found//$'\n'/ }"
}
completes render ren
completes run survey r
completes --photo fit --ph
completes --local survey run --lo
completes mono invert --spectrum mo
[[ -z $(complete_in_bash fit --photo "" | tr -d '\n') ]] || fail "options where a photograph is meant"
if command -v zsh >/dev/null; then zsh -n share/zsh/vendor-completions/_vegard || fail "zsh does not read its file"; fi
if command -v fish >/dev/null; then fish -n share/fish/vendor_completions.d/vegard.fish || fail "fish does not read its file"; fi
for shell in bash zsh fish; do expect_exit 0 manual --completion $shell; done
expect_exit 2 manual nonsense
expect_one_message
