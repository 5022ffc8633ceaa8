"""Writes a measure, the section [variant.NAME], into the text of a site.toml. Knows nothing of QGIS.

What a site file may hold is known by the tools alone: they read what is written here.
"""
import json
import os
import re
import shutil

from . import tools

# Strings, remarks, brackets and ends of lines; what lies between them does not matter here.
TOKEN = re.compile(r'''"""(?:\\.|[^\\])*?"""|\'{3}.*?\'{3}|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'|#[^\n]*|[\[\]{}\n]''',
                   re.DOTALL)
HEADING = re.compile(r'''\s*\[\[?((?:"(?:\\.|[^"\\])*"|\'[^\']*\'|[^\]"\'])*)\]''')
NAME = re.compile(r'''"((?:\\.|[^"\\])*)"|\'([^\']*)\'|([\w-]+)''')


def statements(toml):
    """A text of TOML in parts: a heading, a key with its value, a remark or a blank line each, with its line end."""
    found, start, depth = [], 0, 0
    for token in TOKEN.finditer(toml):
        depth += (token[0] in ("[", "{")) - (token[0] in ("]", "}"))
        if token[0] == "\n" and depth <= 0:
            found.append(toml[start:token.end()])
            start, depth = token.end(), 0
    return found + [toml[start:]] * (start < len(toml))


def heading_of(statement):
    """Names in a heading, of [a.b]: a, b; None: the statement is another one."""
    found = HEADING.match(statement)
    return ["".join(parts) for parts in NAME.findall(found[1])] if found else None


def value_words(value):
    if isinstance(value, list):
        return "[" + ", ".join(value_words(v) for v in value) + "]"
    return tools.number_word(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


def key_words(names):
    return ".".join(name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else value_words(name) for name in names)


def measure_section(name, values, others):
    """Lines of [variant.NAME]: pairs of key (its names) and value (None: not given), then lines of TOML.

    Raises ValueError where `others` begin another section.
    """
    for statement in statements("\n".join(others)):
        if heading_of(statement) is not None:
            raise ValueError("\"%s\" begins another section, expected KEY = VALUE" % statement.strip())
    return (["[" + key_words(["variant", name]) + "]"] +
            [key_words(key) + " = " + value_words(value) for key, value in values if value is not None] + others)


def with_measure(toml, name, section):
    """The text with `section` as that measure. All other lines stay, and remarks in lines of their own."""
    own, waiting, is_own = [], [], False
    parts = statements(toml)
    for i, part in enumerate(parts):
        heading = heading_of(part)
        if heading is not None:
            is_own, waiting = heading[:2] == ["variant", name], []
        # Remarks and blank lines behind the last key belong to the section that follows.
        waiting.append(i)
        if is_own and part.strip() and not part.lstrip().startswith("#"):
            own += waiting
            waiting = []
    end = "\r\n" if "\r\n" in toml else "\n"
    new = [line + end for line in section]
    if not own:
        return toml + end * (1 if toml.endswith("\n") else 2) + "".join(new)
    remarks = [parts[i] for i in own if parts[i].lstrip().startswith("#")]
    return "".join(parts[:own[0]] + new[:1] + remarks + new[1:] +
                   [part for i, part in enumerate(parts) if i > own[0] and i not in own])


def file_words(site, source):
    """A file (and its layer) as site.toml in the folder `site` names it: from there if it lies there, else whole."""
    file, bar, layer = source.partition("|")
    file, here = os.path.abspath(file), os.path.join(os.path.abspath(site), "")
    if os.path.normcase(file).startswith(os.path.normcase(here)):
        return file[len(here):].replace(os.sep, "/") + bar + layer
    return tools.inside(file) + bar + layer


def text_of(path):
    """Text of a file, with the ends of its lines as they are."""
    with open(path, encoding="utf-8", newline="") as file:
        return file.read()


def write_text(path, text):
    """Replaces a file at once, or not at all."""
    path = os.path.realpath(path)
    with open(path + ".new", "w", encoding="utf-8", newline="") as file:
        file.write(text)
    shutil.copymode(path, path + ".new")
    os.replace(path + ".new", path)
