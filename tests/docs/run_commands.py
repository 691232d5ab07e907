#!/usr/bin/env python3
"""Runs the commands of a page of the documentation as they are written.

usage: run_commands.py VEGARD SOURCE_FOLDER PAGE     the page, as README.md or docs/map.md
       run_commands.py --pages SOURCE_FOLDER         whether pages.txt has every page with shell commands
       run_commands.py --self-check                  whether this script notices what it is for

Fences of the page, in order, in one new folder, each by a shell of its own:
  ```sh                      is run by bash -eu; it must end with exit code 0
  ```sh exit="5"             is run, and must end with this code
  ```sh not-run="reason"     is not run: its subcommands and options must exist
  ```toml file="mine.toml"   is written to that file
The folder has data/ and the files that placeholders.txt names; build/release/vegard, and vegard on PATH, are the program.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import pages

HERE = pathlib.Path(__file__).resolve().parent
FENCE = re.compile(r"^(?P<ticks>`{3,})(?P<info>.*)$")
INFO = re.compile(r"""^(?P<language>\w*)(?P<attributes>(?:\s+[\w-]+="[^"]*")*)\s*$""")
OPTION = re.compile(r"^--?[A-Za-z][\w-]*")


class Wrong(Exception):
    """What is wrong with a page; its words begin with page and line."""


class Block:
    def __init__(self, page, line, language, attributes):
        self.where = f"{page}:{line}"
        self.language = language
        self.attributes = attributes
        self.lines = []

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"


def blocks_of(page, text):
    """All fenced blocks. Throws for one that nobody ends, and for attributes of shell blocks that mean nothing."""
    blocks, open_block, ticks, indent = [], None, "", ""
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line.strip())
        if open_block is None:
            if fence is None:
                continue
            ticks = fence["ticks"]
            indent = line[: len(line) - len(line.lstrip())]
            info = INFO.match(fence["info"])
            language = info["language"] if info else fence["info"].split()[0]
            attributes = dict(re.findall(r'([\w-]+)="([^"]*)"', fence["info"])) if info else {}
            open_block = Block(page, number, language, attributes)
            if language in ("sh", "bash", "shell", "console") and (
                info is None or language != "sh" or not set(attributes) <= {"not-run", "exit"}
            ):
                raise Wrong(f'{page}:{number}: "{fence["info"]}" is none of sh, sh not-run="reason", sh exit="5"')
            if attributes.get("not-run") == "":
                raise Wrong(f"{page}:{number}: not-run without a reason")
        elif fence is not None and fence["ticks"] == ticks and not fence["info"].strip():
            blocks.append(open_block)
            open_block = None
        else:
            open_block.lines.append(line[len(indent) :] if line.startswith(indent) else line)
    if open_block is not None:
        raise Wrong(f"{open_block.where}: this fence never ends")
    return blocks


def whole_lines(text):
    """Commands a line each: without comments, continued lines and open quotes joined."""
    lines, held = [], ""
    for line in text.splitlines():
        held = f"{held}\n{line}" if held else line
        if held.endswith("\\"):
            held = held[:-1] + " "
            continue
        bare, quote = "", ""
        for i, c in enumerate(held):
            if quote:
                quote = "" if c == quote else quote
            elif c in "'\"":
                quote = c
            elif c == "#" and (i == 0 or held[i - 1].isspace()):
                break
            bare += c
        if quote:
            continue
        if bare.strip():
            lines.append(bare)
        held = ""
    if held:
        raise ValueError("a quotation mark or a line that goes on is never ended")
    return lines


def calls_of_vegard(text):
    """The words behind each `vegard` of a text of shell."""
    calls = []
    for line in whole_lines(text):
        lexer = shlex.shlex(line, posix=True, punctuation_chars=";|&()<>")
        lexer.whitespace_split = True
        lexer.commenters = ""
        command = []
        for word in list(lexer) + [";"]:
            if word and set(word) <= set(";|&()<>"):
                while command and re.match(r"^\w+=", command[0]):
                    command.pop(0)
                if command and command[0].rsplit("/", 1)[-1] == "vegard":
                    calls.append(command[1:])
                command = []
            else:
                command.append(word)
    return calls


class Manual:
    """What --help says there is."""

    def __init__(self, vegard):
        self.vegard = vegard
        self.known = {}

    def help_of(self, words):
        key = tuple(words)
        if key not in self.known:
            run = subprocess.run([self.vegard, *words, "--help"], capture_output=True, text=True, check=False)
            self.known[key] = run.stdout if run.returncode == 0 else None
        return self.known[key]

    def subcommands(self, words):
        before = self.help_of(words).partition("\nExit codes:")[0]
        return re.findall(r"^  ([a-z][\w-]*)", before, re.MULTILINE)

    def options(self, words):
        lines = [line for line in self.help_of(words).splitlines() if re.match(r"^ +-", line)]
        return {name for line in lines for name in re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", line)}

    def complaint(self, call):
        """What a call of vegard has that does not exist; none if all is well."""
        path, rest = [], list(call)
        while rest and not rest[0].startswith("-") and self.subcommands(path):
            if rest[0] not in self.subcommands(path):
                return f"there is no subcommand '{' '.join(path + rest[:1])}'"
            path.append(rest.pop(0))
        for word in rest:
            option = OPTION.match(word)
            if option and option[0] not in self.options(path):
                return f"vegard {' '.join(path)} has no option {option[0]}"
        return None


def placeholders(source):
    """(name in the folder, file of the repository)"""
    found = []
    for number, line in enumerate((HERE / "placeholders.txt").read_text().splitlines(), 1):
        words = line.partition("#")[0].strip()
        if not words:
            continue
        name, equals, path = (word.strip() for word in words.partition("="))
        if not equals or not (source / path).is_file():
            raise Wrong(f"placeholders.txt:{number}: '{words}' is not NAME = FILE of the repository")
        found.append((name, source / path))
    return found


def furnish(folder, vegard, source):
    """The folder of the commands; gives the environment."""
    shutil.copytree(source / "data", folder / "data")
    for name, path in placeholders(source):
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, target)
    (folder / "build" / "release").mkdir(parents=True)
    (folder / "build" / "release" / "vegard").symlink_to(vegard)
    environment = dict(os.environ)
    environment["PATH"] = f"{folder / 'build' / 'release'}{os.pathsep}{environment['PATH']}"
    return environment


def run_block(block, folder, environment):
    print(f"--- {block.where}\n{block.text}", end="", flush=True)
    run = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", block.text],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        check=False,
    )
    print(run.stdout, end="", flush=True)
    wanted = int(block.attributes.get("exit", "0"))
    if run.returncode != wanted:
        raise Wrong(f"{block.where}: exit code {run.returncode} instead of {wanted}")


def check_block(block, manual):
    calls = calls_of_vegard(block.text)
    for call in calls:
        complaint = manual.complaint(call)
        if complaint:
            raise Wrong(f"{block.where}: {complaint}")


def check_page(vegard, source, page):
    """Every wrong block in words. A block after a wrong one is looked at too: it may be wrong by itself."""
    blocks = blocks_of(page, (source / page).read_text())
    problems, run = [], 0
    manual = Manual(vegard)
    with tempfile.TemporaryDirectory(prefix="vegard-docs-") as name:
        folder = pathlib.Path(name)
        environment = furnish(folder, vegard, source)
        for block in blocks:
            try:
                if block.language == "toml" and "file" in block.attributes:
                    (folder / block.attributes["file"]).write_text(block.text)
                elif block.language == "sh" and "not-run" in block.attributes:
                    check_block(block, manual)
                elif block.language == "sh":
                    check_block(block, manual)
                    run_block(block, folder, environment)
                    run += 1
            except (Wrong, ValueError) as problem:
                words = str(problem)
                problems.append(words if words.startswith(page) else f"{block.where}: {words}")
    print(f"{page}: {len(blocks)} fences, {run} run, {len(problems)} wrong")
    return problems


def check_list(source):
    """Pages that pages.txt lacks, or has for nothing."""
    lines = (HERE / "pages.txt").read_text().splitlines()
    listed = {line.split()[0] for line in lines if line.strip() and not line.startswith("#")}
    problems = [f"pages.txt: there is no {page}" for page in sorted(listed) if not (source / page).is_file()]
    for page in pages.tracked_pages(source):
        if page not in listed and not page.startswith("tests/"):
            if any(block.language == "sh" for block in blocks_of(page, (source / page).read_text())):
                problems.append(f"{page} has shell commands and is not in tests/docs/pages.txt")
    return problems


def self_check():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        fake = folder / "vegard"
        fake.write_text(
            "#!/bin/sh\n"
            'case "$*" in\n'
            '"--help") printf "x\\nSubcommands:\\n  render   Make\\n  survey  Many\\n" ;;\n'
            '"render --help") printf "Options:\\n  -o,--output TEXT  Where; see --frames\\n  --seed INT\\n" ;;\n'
            '"survey --help") printf "x\\nSubcommands:\\n  run   Go\\n" ;;\n'
            '"survey run --help") printf "Options:\\n  --out TEXT\\n" ;;\n'
            "*) exit 2 ;;\nesac\n"
        )
        fake.chmod(0o755)
        manual = Manual(fake)
        good = ["render a.toml -o b.png --seed=3", "survey run p.json --out -20,3", "render a#3.gz -o '--x y'.png"]
        for words in good:
            (call,) = calls_of_vegard(f"x=3 build/release/vegard {words}  # --none\n")
            assert manual.complaint([w for w in call if w != "--x y.png"]) is None, words
        for words in ("rendre a", "render a --oputput b", "survey walk", "survey run --seed 3"):
            (call,) = calls_of_vegard(f"vegard {words}\n")
            assert manual.complaint(call), words
        assert calls_of_vegard("true && vegard a \\\n  --b | head\necho vegard c; (vegard 'd\ne')\n") == [
            ["a", "--b"],
            ["d\ne"],
        ]
        for text in ("```sh run\n```\n", '```sh not-run=""\n```\n', "```bash\nls\n```\n", "```sh\nls\n"):
            try:
                blocks_of("p.md", text)
            except Wrong as problem:
                assert str(problem).startswith("p.md:1: "), problem
            else:
                raise AssertionError(f"nothing is wrong with {text!r}")
        blocks = blocks_of("p.md", '- x\n  ```sh exit="5"\n  ls\n  ```\n```toml file="a.toml"\nb = 1\n```\n')
        assert [(b.where, b.text, b.attributes) for b in blocks] == [
            ("p.md:2", "ls\n", {"exit": "5"}),
            ("p.md:5", "b = 1\n", {"file": "a.toml"}),
        ]
        for text, attributes in (("exit 3", {}), ("true", {"exit": "5"}), ("false; true", {}), ("echo $none", {})):
            block = Block("p.md", 1, "sh", attributes)
            block.lines = [text]
            try:
                run_block(block, folder, dict(os.environ))
            except Wrong:
                continue
            raise AssertionError(f"nothing is wrong with {text!r}")
    print("run_commands: notices what it is for")


def main(words):
    if words == ["--self-check"]:
        self_check()
        return 0
    if len(words) != 3 and words[:1] != ["--pages"]:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        if words[0] == "--pages":
            problems = check_list(pathlib.Path(words[1]).resolve())
        else:
            problems = check_page(os.path.abspath(words[0]), pathlib.Path(words[1]).resolve(), words[2])
    except Wrong as problem:
        problems = [str(problem)]
    for problem in problems:
        print(f"FAILED: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
