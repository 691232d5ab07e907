#!/usr/bin/env python3
"""Whether the documentation is spelt as the dictionary of British English or words.txt has it; code is left out.

usage: check_spelling.py SOURCE_FOLDER            exit code 1 and places for unknown words; 77 without hunspell
       check_spelling.py SOURCE_FOLDER --words    only the unknown words, one a line, for words.txt
       check_spelling.py --self-check
"""

import pathlib
import re
import shutil
import subprocess
import sys

import pages

HERE = pathlib.Path(__file__).resolve().parent
WORD = re.compile(r"[^\W\d_]+(?:['’][^\W\d_]+)*")
SYMBOL = re.compile(r".[A-Z]|[ᵃ-ᶻⁱⁿᴬ-ᵂ]")  # NetCDF, gainᵏ
SKIPPED = re.compile(
    r"<!--.*?-->"  # comments
    r"|<[^>]+>"  # tags
    r"|\]\([^)]*\)"  # targets of links
    r"|https?://\S+"
    r"|\$[^$]+\$"  # formulas
    r"|\"[^\"]*\""  # titles and words of others
    r"|\S*[/_=@]\S*"  # paths, keys
    r"|\S+\.(?:md|toml|csv|png|jpg|exr|cpp|h|py|sh|json|html|fits|nc|txt)\b"
)


def words_of(text):
    """(line number, word) of the prose; short ones, and those with digits, of capitals alone or with one inside, are names and symbols."""
    for number, line in pages.prose_lines(text):
        for token in re.findall(r"[\w'’]+", SKIPPED.sub(" ", line)):
            if re.search(r"\d", token):
                continue
            for word in WORD.findall(token):
                plain = re.sub(r"['’]s$", "", word).replace("’", "'")
                if len(plain) > 2 and not SYMBOL.search(plain) and not plain.isupper():
                    yield number, plain


def known_words():
    lines = (HERE / "words.txt").read_text().splitlines()
    return {line.strip() for line in lines if line.strip() and not line.startswith("#")}


def unknown(words):
    """Which of them the dictionary does not have."""
    run = subprocess.run(
        ["hunspell", "-d", "en_GB", "-i", "utf-8", "-l"],
        input="\n".join(sorted(words)) + "\n",
        capture_output=True,
        text=True,
        check=True,
    )
    return set(run.stdout.split())


def is_installed():
    if shutil.which("hunspell") is None:
        return False
    run = subprocess.run(["hunspell", "-D"], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return re.search(r"\ben_GB\b", run.stdout + run.stderr) is not None


def problems_of(source, names):
    """(page, line, word)"""
    found = [(name, number, word) for name in names for number, word in words_of((source / name).read_text())]
    own = known_words()
    wrong = unknown({word for _, _, word in found if word not in own and word.lower() not in own})
    return [(name, number, word) for name, number, word in found if word in wrong]


def self_check():
    text = (
        "The colour of auroras\n```sh\nteh color\n```\n`teh` [x](teh.md) teh/wrod a2teh FOOBARX NetCDF teh_x \"Teh Color\" gainᵏ\n"
        "An arc's centre ofthe sky\n"
    )
    words = {word for _, word in words_of(text)}
    assert words == {"The", "colour", "of", "auroras", "An", "arc", "centre", "ofthe", "sky"} - {"of", "An"}, words
    assert list(words_of("a\nteh"))[0] == (2, "teh")
    if is_installed():
        assert unknown({"colour", "color", "centre", "center", "teh"}) == {"color", "center", "teh"}
    listed = [line for line in (HERE / "words.txt").read_text().splitlines() if line and not line.startswith("#")]
    assert listed == sorted(set(listed), key=lambda word: (word.lower(), word)), "words.txt is not sorted, or has a word twice"
    print("check_spelling: notices what it is for")


def main(words):
    if words == ["--self-check"]:
        self_check()
        return 0
    if not is_installed():
        print("hunspell with its dictionary en_GB is not installed")
        return 77
    source = pathlib.Path(words[0]).resolve()
    names = [name for name in pages.tracked_pages(source) if name not in pages.GENERATED]
    problems = problems_of(source, names)
    if "--words" in words:
        print("\n".join(sorted({word for _, _, word in problems}, key=lambda word: (word.lower(), word))))
        return 0
    for name, number, word in problems:
        print(f"{name}:{number}: '{word}' (a word of the field goes into tests/docs/words.txt)", file=sys.stderr)
    print(f"{len(names)} pages, {len(problems)} unknown words")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
