#!/usr/bin/env python3
"""Checks that the page of talus-report and the file of its words (tools/report/texts.toml) fit.

- Each key that the code names is in the file, and the code names each key of the file.
- A text that stands in the code as `texts.of("key", {{"name", ...}})` has exactly these {name}s.
- No two words in a row are left in the code of the page.
"""
import pathlib
import re
import sys
import tomllib

ROOMS = ["tools/report", "libcore/report"]
# Not of the page: its data and what is wrong with them, the QGIS project, the look before the runs.
NOT_THE_PAGE = {"talus_report.cpp", "folder.cpp", "project.cpp", "qgis_project.cpp", "qgis_template_gdal.cpp",
                "field_words.cpp", "check_view_cairo.cpp", "texts.cpp", "texts_toml.cpp",
                "map_cells_gdal.cpp", "styles_gdal.cpp", "viewer_scene.cpp"}
FILE_ENDINGS = {"csv", "gpkg", "html", "json", "js", "pdf", "png", "qgz", "qml", "svg", "tif", "toml", "css"}
# What results of other tools say, where the code asks for it; classes of the style sheet.
ALLOWED = {"line that stops nothing", "does not meet", "nothing came"}
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
WORDS = re.compile(r"(?<![\w.#-])[A-Za-z]{2,}(?: [a-z]{2,})+")


def texts_of(table, of=""):
    """Of each key "section.key" its texts."""
    for name, node in table.items():
        if isinstance(node, dict):
            yield from texts_of(node, of + name + ".")
        else:
            yield of + name, [node] if isinstance(node, str) else node


def keys_in(source, sections):
    """Literals "section.key" of C++, {{section.key}} of a script."""
    for literal in LITERAL.findall(source) + re.findall(r"\{\{([\w.]+)\}\}", source):
        section, _, key = literal.partition(".")
        if section in sections and re.fullmatch(r"\w+", key) and key not in FILE_ENDINGS:
            yield literal


def calls_in(source):
    """Of each call of texts.of(): the keys of its first argument, the names of its values."""
    for call in re.finditer(r"\btexts\.of\(", source):
        depth, braces, names, keys, in_first = 1, 0, set(), [], True
        at = call.end()
        while depth > 0:
            literal = LITERAL.match(source, at)
            if literal:
                if in_first:
                    keys.append(literal[1])
                elif depth == 1 and braces == 2 and source[:at].rstrip()[-1] == "{":
                    names.add(literal[1])
                at = literal.end()
                continue
            c = source[at]
            depth += (c == "(") - (c == ")")
            braces += (c == "{") - (c == "}")
            in_first = in_first and not (c == "," and depth == 1)
            at += 1
        yield keys, names


def main():
    root = pathlib.Path(sys.argv[1])
    file = root / "tools/report/texts.toml"
    table = tomllib.loads(file.read_text())
    texts = dict(texts_of(table))
    named = {key: set(re.findall(r"\{(\w+)\}", " ".join(parts))) for key, parts in texts.items()}
    faults, used = [], set()
    for path in [path for room in ROOMS for path in sorted((root / room).glob("*"))]:
        if path.suffix not in {".cpp", ".js"} or path.name in NOT_THE_PAGE:
            continue
        source = path.read_text()
        where = path.relative_to(root)
        code = re.sub(r"(?m)(^|\s)//.*$", "", source)
        for key in keys_in(code, table):
            used.add(key)
            if key not in texts:
                faults.append(f"{where}: {key} is not in {file.name}")
        for keys, names in calls_in(code) if path.suffix == ".cpp" else []:
            known = [named[key] for key in keys if key in texts]
            if known and names != set.union(*known):
                faults.append(f"{where}: gives {sorted(names)} to {keys}, which have {sorted(set.union(*known))}")
        for literal in LITERAL.findall(code) if path.suffix == ".cpp" else []:
            if literal not in ALLOWED and "document." not in literal and WORDS.search(re.sub(r"<[^>]*>?|&\w+;", "", literal)):
                faults.append(f"{where}: \"{literal}\" belongs into {file.name}")
    faults += [f"{file.relative_to(root)}: {key} is used by no code" for key in sorted(set(texts) - used)]
    print("\n".join(faults) if faults else f"{len(texts)} texts, each used; no other is")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
