#!/usr/bin/env python3
"""check_constants.py FOLDER...: each constant (kName) that a source declares is used in it.

Compilers tell that only of the file they compile, not of those that are compiled together with it.
"""
import collections
import pathlib
import re
import sys

NAME = re.compile(r"\bk[A-Z]\w*")
DECLARED = re.compile(r"(?:const|constexpr|,)\s+(?:[\w:<>, ]+\s)?(k[A-Z]\w*)(?:\[[^\]]*\])?\s*[={]")


def unused(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
    times = collections.Counter(NAME.findall(text))
    return [name for name in DECLARED.findall(text) if times[name] == 1]


found = [(path, name) for folder in sys.argv[1:] for path in sorted(pathlib.Path(folder).rglob("*.cpp"))
         for name in unused(path.read_text())]
for path, name in found:
    print(f"{path}: {name} is declared and not used")
sys.exit(bool(found))
