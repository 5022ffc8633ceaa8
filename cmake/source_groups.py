"""Deals sources out to groups that compile as one: source_groups.py INCLUDE_FOLDER SIZE SOURCE...

Prints the number of each source's group, in the order given. Two sources share a group only if no
name of an anonymous namespace of one is declared by the other, or by a header of ours that it
includes: such names would meet. A group has at most SIZE sources.
"""
import functools
import pathlib
import re
import sys

KEYWORDS = {"if", "for", "while", "switch", "return", "operator", "alignas", "requires", "noexcept", "decltype",
            "static_assert", "TEST", "TEST_F", "TEST_P", "INSTANTIATE_TEST_SUITE_P", "RC_GTEST_PROP",
            "RC_GTEST_FIXTURE_PROP"}
TYPE = re.compile(r"(?:struct|class|enum|union|concept|namespace)(?: class| struct)? (\w+)")
ALIAS = re.compile(r"using (\w+) =")
CALLABLE = re.compile(r"(?<![:.>\w])([A-Za-z_]\w*)\(")
VARIABLE = re.compile(r"(?<![-:.>\w])(?<![-+*/=] )([A-Za-z_]\w*)(?:\[[^\]]*\])*(?: =|\{|;)")
REMARK = re.compile(r' *//.*|"(?:\\.|[^"\\])*"')
INCLUDE = re.compile(r'#include "([^"]+)"', re.MULTILINE)


def declared(line):
    """Names that a line at the margin of a file may declare."""
    line = REMARK.sub("", line)
    names = set(TYPE.findall(line)) | set(ALIAS.findall(line))
    called = CALLABLE.findall(line.split(" = ")[0].split("{")[0])  # before a value or a body
    names.update(called[:1] or VARIABLE.findall(line))
    if line.startswith("using "):
        names.update(re.findall(r"(\w+)(?=[,;])", line))
    return names - KEYWORDS


@functools.cache
def names_of(path):
    """(names of anonymous namespaces, other names) at the margin of one file"""
    private, public, depth = set(), set(), 0
    for line in path.read_text().splitlines():
        if line.startswith("namespace {"):
            depth = 1
        elif line.startswith("}  // namespace") and not re.match(r"\}  // namespace \w", line):
            depth = 0
        elif line[:1].isalpha() and not line.startswith(("namespace", "template <", "using namespace")):
            (private if depth and not line.startswith("using ") else public).update(declared(line))
        elif line.startswith(("#define ", "template <")):
            public.update(declared(line))
    return private, public


@functools.cache
def headers_of(path, folder):
    """All headers of ours that a file includes, itself left out."""
    found = set()
    for name in INCLUDE.findall(path.read_text()):
        for header in (path.parent / name, folder / name, folder.parent / name):
            if header.is_file():
                found |= {header} | headers_of(header, folder)
                break
    return found


def visible(path, folder):
    return set().union(names_of(path)[1], *(names_of(header)[1] for header in headers_of(path, folder)))


def main():
    folder, size = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    groups = []  # [sources, private names, all names that are seen]
    numbers = []
    for source in map(pathlib.Path, sys.argv[3:]):
        private = names_of(source)[0]
        seen = visible(source, folder) | private
        for number, (sources, others, all_seen) in enumerate(groups):
            if len(sources) < size and not private & all_seen and not others & seen:
                break
        else:
            number = len(groups)
            groups.append([[], set(), set()])
        groups[number][0].append(source)
        groups[number][1] |= private
        groups[number][2] |= seen
        numbers.append(number)
    print(*numbers, sep=";")


main()
