#!/usr/bin/env python3
"""Tests ask for facts: numbers, keys, names, exit codes. Those that ask for a sentence keep it from being bettered.

usage: sentences.py [--list | --self-check] SOURCE_FOLDER

Counts texts of more than three words that unit tests and tests/cli compare with what the program says; facts divided by
" | " count one by one. Fails if there are more than MOST: those that are left are names of results, columns and files.
"""
import pathlib
import re
import sys

MOST = 121
TEXT = r'"((?:[^"\\]|\\.)*)"'
WORD = re.compile(r"[('\"]?[A-Za-z][a-z]+(?:['-][a-z]+)*[,.;:)'\"]*")


def is_sentence(text):
    """More than three words in a row of a fact; files of scenes, of which tests have many, are none."""
    return "\\n" not in text and "\n" not in text and "= " not in text and any(
        sum(bool(WORD.fullmatch(word)) for word in fact.split()) > 3 for fact in text.split(" | "))


def of_unit_test(source):
    for statement in re.split(r";\s*\n", source):
        if re.search(r"EXPECT_|ASSERT_|expect_|Bad\b", statement):
            code = "\n".join(line for line in statement.split("\n") if not re.match(r"\s*(#|//)", line))
            # What stands behind << is said by the test itself.
            yield from (text[1] for text in re.finditer(r"(?<!<< )" + TEXT, code) if is_sentence(text[1]))


def of_case(source):
    for line in source.split("\n"):
        check = re.search(r"\b(expect_std(out|err)|refuse[ds]|grep)\b.*", line)
        if check and not line.lstrip().startswith("#"):
            asked = re.sub(r'\bfail ".*', "", check[0])
            yield from (a or b for a, b in re.findall(TEXT + "|'([^']*)'", asked) if is_sentence(a or b))


def sentences_of(folder):
    for file in sorted((folder / "tests").glob("**/*_test.cpp")):
        yield from ((file, text) for text in of_unit_test(file.read_text()))
    for file in sorted((folder / "tests/cli").glob("*_case.sh")):
        yield from ((file, text) for text in of_case(file.read_text()))


def self_check():
    assert list(of_unit_test('EXPECT_NE(text.find("there is no such thing"), npos) << "with a word or two";\n')) == ["there is no such thing"]
    assert list(of_unit_test('EXPECT_TRUE(has_facts(text, "a.toml:3 | energy_kev | 0 to 3"));\n')) == []
    assert list(of_unit_test('const char* said = "here is a sentence of no test";\n')) == []
    assert list(of_case('expect_stderr "the file is no picture"')) == ["the file is no picture"]
    assert list(of_case('expect_stderr "a.png: | 3 x 4 | picture"')) == []
    assert list(of_case('grep -q x y || fail "that is not in the file"')) == []


def main():
    if "--self-check" in sys.argv:
        self_check()
        return 0
    found = list(sentences_of(pathlib.Path(sys.argv[-1])))
    if "--list" in sys.argv or len(found) > MOST:
        for file, text in found:
            print(f"{file}: {text}")
    print(f"{len(found)} sentences are asked for, at most {MOST} are allowed")
    return 1 if len(found) > MOST else 0


if __name__ == "__main__":
    sys.exit(main())
