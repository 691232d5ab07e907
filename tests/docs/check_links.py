#!/usr/bin/env python3
"""Whether every relative link of the documentation leads to a file, and its anchor to a heading.

usage: check_links.py SOURCE_FOLDER | --self-check
"""

import pathlib
import re
import sys
import tempfile
import urllib.parse

import pages

LINK = re.compile(r"!?\[(?:[^\]\[]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^\s*\[[^\]]+\]:\s+(\S+)")
ATTRIBUTE = re.compile(r"""\b(?:href|src)=["']([^"']+)["']""")


def anchor_of(heading):
    """As GitHub and most others make them of a heading."""
    words = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    words = words.replace("`", "").replace("*", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def headings(text):
    """Lines of headings as they stand, with their code."""
    fence = ""
    for line in text.splitlines():
        ticks = re.match(r"\s*(`{3,}|~{3,})", line)
        if ticks and not fence:
            fence = ticks[1]
        elif ticks and line.strip() == fence:
            fence = ""
        elif not fence and re.match(r"#{1,6} ", line):
            yield line.lstrip("#").strip().rstrip("#").strip()


def anchors_of(text):
    found, times = set(), {}
    for heading in headings(text):
        anchor = anchor_of(heading)
        count = times.get(anchor, 0)
        times[anchor] = count + 1
        found.add(f"{anchor}-{count}" if count else anchor)
    found.update(re.findall(r"<a\s+(?:id|name)=[\"']([^\"']+)", text))
    return found


def problems_of(source, names):
    texts = {name: (source / name).read_text() for name in names}
    problems = []
    for name, text in texts.items():
        for number, line in pages.prose_lines(text):
            for target in LINK.findall(line) + REFERENCE.findall(line) + ATTRIBUTE.findall(line):
                if re.match(r"[a-z][a-z0-9+.-]*:", target):
                    continue
                path, _, anchor = urllib.parse.unquote(target).partition("#")
                place = ((source / name).parent / path).resolve() if path else source / name
                if not place.exists():
                    problems.append(f"{name}:{number}: there is no file {path}")
                elif source not in place.parents and place != source:
                    problems.append(f"{name}:{number}: {path} is outside of the repository")
                elif anchor and place.suffix == ".md" and anchor not in anchors_of(place.read_text()):
                    problems.append(f"{name}:{number}: {path or name} has no heading #{anchor}")
    return problems


def self_check():
    with tempfile.TemporaryDirectory() as name:
        source = pathlib.Path(name).resolve()
        (source / "docs").mkdir()
        (source / "docs" / "a.md").write_text(
            "# What `a` is: B's (and C)\n## Twice\n## Twice\n```\n# No heading\n[x](none.md)\n```\n`[x](none.md)`\n"
            "[b](b.md#one) [c](../c.png) [d](https://none.example/x.md) [here](#twice-1) [e](#what-a-is-bs-and-c)\n"
        )
        (source / "docs" / "b.md").write_text("# One\n")
        (source / "c.png").write_text("")
        assert problems_of(source, ["docs/a.md", "docs/b.md"]) == []
        for link in ("[x](none.md)", "[x](b.md#two)", "[x](#no-heading)", "![x](c.png)", "[x]: none.md", '<img src="n.png">'):
            (source / "docs" / "b.md").write_text(f"# One\n{link}\n")
            assert len(problems_of(source, ["docs/b.md"])) == 1, link
    print("check_links: notices what it is for")


def main(words):
    if words == ["--self-check"]:
        self_check()
        return 0
    source = pathlib.Path(words[0]).resolve()
    names = pages.tracked_pages(source)
    problems = problems_of(source, names)
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{len(names)} pages, {len(problems)} wrong links")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
