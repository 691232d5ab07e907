#!/usr/bin/env bash
# vegard studio: what its server answers, and to whom; bad calls. The page itself is tests/browser/studio.py.
source "$(dirname "${BASH_SOURCE[0]}")/case.sh"

mkdir inside
echo secret >secret.txt
cp "$SCENES/small.toml" inside/scene.toml
python3 "$SOURCE/tests/cli/studio_requests.py" "$VEGARD" "$folder/inside" >"$stdout" 2>"$stderr" || fail "requests"

expect_exit 2 studio /etc
expect_stderr "/etc | working directory"
expect_exit 3 studio nothing.jpg
expect_stderr "nothing.jpg"
expect_exit 2 studio --port 70000
