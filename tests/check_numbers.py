#!/usr/bin/env python3
"""Counts the numbers that somebody chose in the engine, and holds that they do not grow.

A number counts when it is a constant of a numeric type with a literal in its value; constants made
of others, infinities, and names of bodies do not. The tables are solver/law_numbers.hpp and
solver/mass_numbers.hpp; each number there says what it trades.

    check_numbers.py ROOT [--list]
"""
import pathlib
import re
import sys

ROOMS = ["contact", "motion", "scene", "solver", "step"]
TABLES = ["solver/law_numbers.hpp", "solver/mass_numbers.hpp"]
MOST, MOST_IN_TABLES = 166, 64

TYPE = r"(?:double|float|int|auto|(?:std::)?size_t|std::u?int\d+_t)"
CONSTANT = re.compile(r"\bconstexpr\s+" + TYPE + r"\s+([^;]*);")
LITERAL = re.compile(r"(?<![\w.])\d+(?:\.\d*)?(?:[eE][+-]?\d+)?[FfUuLl]*(?![\w.])")


def numbers(text):
    """Names of the constants with a literal in their value."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
    for statement in CONSTANT.findall(text):
        if re.match(r"\w+\s*\(", statement):
            continue  # a function
        for part in re.split(r",\s*(?=\w+\s*=)", statement):
            name, equals, value = part.partition("=")
            if equals and LITERAL.search(value):
                yield name.strip()


def main():
    root = pathlib.Path(sys.argv[1]) / "libcore"
    total = in_tables = 0
    for room in ROOMS:
        for file in sorted((root / room).rglob("*.?pp")):
            names = list(numbers(file.read_text()))
            total += len(names)
            if str(file.relative_to(root)) in TABLES:
                in_tables += len(names)
            if "--list" in sys.argv and names:
                print(f"{file.relative_to(root)}: {len(names)}: {', '.join(names)}")
    print(f"{total} numbers in the engine, {in_tables} of them in the tables")
    if total > MOST or in_tables > MOST_IN_TABLES:
        sys.exit(
            f"at most {MOST} and {MOST_IN_TABLES} were expected: use a number that is there, "
            "or take one out for each that comes"
        )


main()
