"""The pages of the documentation and what is prose in them, for the checks of this folder."""

import re
import subprocess

GENERATED = ("docs/parameters.md", "docs/forms.md", "docs/lines.md")


def tracked_pages(source):
    """Every page in Markdown that the repository has, where git knows; else those in the usual places."""
    run = subprocess.run(["git", "-C", str(source), "ls-files", "*.md"], capture_output=True, text=True, check=False)
    if run.returncode == 0 and run.stdout:
        names = run.stdout.splitlines()
    else:
        places = [*source.glob("*.md"), *source.glob("docs/**/*.md"), *source.glob("data/**/*.md")]
        names = [str(path.relative_to(source)) for path in places]
    return sorted(name for name in names if (source / name).is_file())


def prose_lines(text):
    """(number, line) without fenced blocks; inline code is blanked."""
    fence = ""
    for number, line in enumerate(text.splitlines(), 1):
        ticks = re.match(r"\s*(`{3,}|~{3,})", line)
        if ticks and not fence:
            fence = ticks[1]
        elif ticks and line.strip() == fence:
            fence = ""
        elif not fence:
            yield number, re.sub(r"(`+)(?!`).+?(?<!`)\1(?!`)", " ", line)
