# All of the made files of declared_case.sh, some three hundred calls.
export VEGARD_DECLARED=whole
# shellcheck source=tests/cli/declared_case.sh
source "$(dirname "$0")/declared_case.sh"
