"""The tools of Talus as programs: their places, options and messages. Knows nothing of QGIS.

The options of a tool come from itself (`talus-x --describe json`), the goals of make from `make help`:
neither is repeated here.
"""
import functools
import json
import os
import re
import shutil
import subprocess
from collections import namedtuple

# Read from a site file alone, or of no use in a dialog.
NOT_SHOWN = {"quiet", "verbose", "json", "overwrite", "label", "failures", "progress", "messages", "print-config",
             "describe", "no-db"}
EXTENSIONS = {"GeoTIFF": "tif", "GeoPackage": "gpkg", "HDF5": "h5", "JSON": "json", "CSV": "csv", "SVG": "svg",
              "PNG": "png", "HTML": "html", "QGZ": "qgz", "TOML": "toml", "PLY": "ply"}
# Goals with a dialog of their own, or that need a terminal.
GOALS_NOT_SHOWN = {"new-site", "submit", "runs-shard"}
LONGEST_WAIT_S = 20
# Group under which an engineer looks for a tool; the rest are in "Files and runs".
GROUPS = {"Terrain": ["import", "tin", "trn"], "Source and blocks": ["source", "blocks", "stability", "check"],
          "Runs": ["dda", "batch", "verify"], "Run-out and maps": ["runout", "maps", "profile", "calibrate", "places"],
          "Hazard and objects": ["hazard", "trace"], "Protection": ["fence", "fence-search"]}

# Words that start the tools elsewhere, in WSL or in a container; empty: they are of this machine.
before = []


# --- where they are ------------------------------------------------------------------------------

def inside(word):
    """A word of a command line as the place behind `before` sees it: C:\\a\\b is /mnt/c/a/b in WSL, and has to
    be in a container."""
    if not before:
        return word
    found = re.match(r"(?s)(.*=|)([A-Za-z]):[\\/](.*)", word)
    return "%s/mnt/%s/%s" % (found[1], found[2].lower(), found[3].replace("\\", "/")) if found else word


def started(words):
    """A command line, behind `before` where the tools are elsewhere."""
    return before + [inside(word) for word in words]


def answer_of(script):
    """Lines that a script of the shell prints behind `before`."""
    return output_of(before + ["sh", "-c", script]).split()


def tool_path(name, folder=""):
    """Path of a tool: in `folder` where that is given, else on the search path; "" where it is not."""
    if before:
        return (folder.rstrip("/") + "/" + name if folder else name) if name in tool_names(folder) else ""
    return shutil.which(name, path=folder or None) or ""


@functools.lru_cache(maxsize=None)
def names_elsewhere(words, folder):
    """As tool_names(), asked once of each place: a container takes its time."""
    place = "'%s'" % folder if folder else '"$(dirname "$(command -v talus-site)")"'
    return tuple(sorted(n for n in answer_of("ls " + place) if re.fullmatch(r"talus-[a-z-]+", n)))


def tool_names(folder=""):
    """Names of the tools that there are, in alphabetical order."""
    if before:
        return list(names_elsewhere(tuple(before), folder))
    places = [folder] if folder else os.environ.get("PATH", "").split(os.pathsep)
    names = set()
    for place in places:
        try:
            entries = os.listdir(place or ".")
        except OSError:
            continue
        names.update(e for e in entries if re.fullmatch(r"talus-[a-z-]+", e) and tool_path(e, folder))
    return sorted(names)


def pipelines_folder(folder=""):
    """The rules of make that belong to the tools: installed beside them, or of the checkout that built them."""
    tool = tool_path("talus-site", folder)
    if not tool:
        return ""
    if before:
        found = answer_of('here=$(dirname "$(readlink -f "$(command -v %s)")"); for there in ../share/talus/pipelines '
                          '../../../pipelines; do [ -f "$here/$there/site.mk" ] && cd "$here/$there" && pwd && break; '
                          'done' % tool)
        return found[0] if found else ""
    here = os.path.dirname(os.path.realpath(tool))
    for place in ("../share/talus/pipelines", "../../../pipelines"):
        found = os.path.normpath(os.path.join(here, place))
        if os.path.isfile(os.path.join(found, "site.mk")):
            return found
    return ""


# --- their options -------------------------------------------------------------------------------

def output_of(words):
    """Output of a program, or "" where it cannot be started, fails or does not end."""
    try:
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL,
                              timeout=LONGEST_WAIT_S, check=False)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.decode("utf-8", "replace") if done.returncode == 0 else ""


def description(name, folder=""):
    """Description of the tool `name` by itself, or None."""
    try:
        found = json.loads(output_of(started([tool_path(name, folder), "--describe", "json"])))
    except ValueError:
        return None
    return found if isinstance(found, dict) and isinstance(found.get("options"), list) else None


def stamp_of(path):
    """Tells one build of a tool from another."""
    if before:
        return " ".join(before + [path])
    at = os.stat(path)
    return "%s %d %d" % (path, at.st_size, at.st_mtime_ns)


def descriptions(folder="", cache=""):
    """Descriptions of all tools. `cache` keeps them, a tool a line of JSON, until a tool is another."""
    known = {}
    try:
        with open(cache, encoding="utf-8") as file:
            known = json.load(file)
    except (OSError, ValueError):
        pass
    if not isinstance(known, dict):
        known = {}
    found, now = [], {}
    for name in tool_names(folder):
        stamp = stamp_of(tool_path(name, folder))
        tool = known.get(stamp) or description(name, folder)
        if tool is not None:
            now[stamp] = tool
            found.append(tool)
    if cache and now != known:
        try:
            with open(cache, "w", encoding="utf-8") as file:
                json.dump(now, file)
        except OSError:
            pass  # asked again next time
    return found


Goal = namedtuple("Goal", "name purpose")


def goals(folder=""):
    """Goals of make for a site, in the order of the pipeline."""
    pipelines = pipelines_folder(folder)
    if not pipelines:
        return []
    words = output_of(started(["make", "-s", "-f", pipelines + "/site.mk", "help"]))
    found = [Goal(*m.groups()) for m in re.finditer(r"^  ([a-z-]+): (.+)$", words, re.MULTILINE)]
    return [goal for goal in found if goal.name not in GOALS_NOT_SHOWN]


def group_of(tool):
    """Group under which an engineer looks for `tool`."""
    name = tool.removeprefix("talus-")
    return next((group for group, names in GROUPS.items() if name in names), "Files and runs")


# --- options -------------------------------------------------------------------------------------

def parameter_name(option):
    """"cell-size-m" -> CELL_SIZE_M"""
    return re.sub(r"[^A-Z0-9]", "_", option["key"].upper())


def shown_options(tool, command=None):
    """Options that a dialog shows, in the order of --help; common ones last."""
    own = tool["options"] if command is None else command["options"] + tool["options"]
    return [o for o in own + tool.get("common_options", []) if o["key"] not in NOT_SHOWN or o["role"] == "output"]


def common_keys(tool):
    return {option["key"] for option in tool.get("common_options", [])}


def extension_of(option):
    """Of a file that is written: the format that its help names in brackets."""
    for found in re.finditer(r"\(([^)]*)\)", option["help"]):
        for word in re.split(r"[ ;,]", found.group(1)):
            if word in EXTENSIONS:
                return EXTENSIONS[word]
    return ""


def is_layer(option):
    """Whether QGIS opens an input as a layer, so that one of the project may be picked."""
    words = option["help"]
    is_map = re.search(r"\b(vector|contours?|lines|points|polygons|spot heights|raster|DEM|terrain|GeoTIFF)\b", words)
    return bool(is_map) and not re.search(r"\b(TIN|CSV|HDF5|TOML|list)\b", words)


def is_given(option, value):
    """Whether a value of a dialog differs from the tool's default."""
    if value is None or value == "" or value == []:
        return False
    default = option.get("default", "")
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        try:
            return float(default) != float(value)
        except ValueError:
            return True
    return str(value) != default


def number_word(number):
    """8.0 as 8: else it would be another setting, and another run id."""
    return repr(number).removesuffix(".0")


def words_of(option, value):
    """Words of the command line for one option."""
    if option["role"] == "flag":
        return [option["spelling"]] if value else []
    if not is_given(option, value):
        return []
    values = value if isinstance(value, (list, tuple)) else [value]
    words = [number_word(v) if isinstance(v, float) else str(v) for v in values]
    if option["positional"]:
        return words
    # One word, so that a value may begin with a dash; each further value names the option again.
    return [option["spelling"] + "=" + word for word in words]


def command_line(tool, values, folder="", command=None):
    """Program and arguments for `values`, a value a key; positional ones last, behind all options."""
    options, places = [], []
    for option in shown_options(tool, command):
        words = words_of(option, values.get(option["key"]))
        if option["positional"]:
            places += words
        else:
            options += words
    common = ["--progress=json", "--messages=json"]
    # QGIS has asked whether a file may be replaced; a resumed one is not.
    if not values.get("resume"):
        common.append("--overwrite")
    ends = ["--"] + places if places else []
    return tool_path(tool["tool"], folder), ([command["name"]] if command else []) + options + common + ends


def goal_command(site, goal, variables, jobs=1, folder=""):
    """Program and arguments of a goal of make in a site's folder; `variables` as NAME=VALUE.

    Make hands an environment on, so the tools say how far they are as objects. It runs the tools that
    the plug-in offers, not those of a checkout that its rules might find.
    """
    words = ["TALUS_PROGRESS=json", "make", "-C", site, "-j%d" % max(1, jobs), "--no-print-directory", goal]
    place = folder or os.path.dirname(tool_path("talus-site"))
    if place:
        words.append("BIN=" + place.rstrip("/") + "/")
    return "env", words + [v for v in variables if v]


def new_site_command(folder_of_site, ground, source, folder=""):
    pipelines = pipelines_folder(folder)
    return "sh", [pipelines + "/new_site.sh", folder_of_site, ground, source, pipelines, folder]


# --- their messages -------------------------------------------------------------------------------

Said = namedtuple("Said", "kind text")  # kind: progress (text: per cent), info, warning, error, hint


def said(line):
    """A line of a tool, or of make, by its meaning; None where nothing is to be shown."""
    line = line.rstrip()
    if not line:
        return None
    if line.startswith("{"):
        try:
            found = json.loads(line)
        except ValueError:
            return Said("info", line)
        if "progress" in found:
            return None if "label" in found else Said("progress", 100 * float(found["progress"]))
        if "text" in found:
            label = found["label"] + ": " if found.get("label") else ""
            return Said(found.get("level", "info"), label + found["text"])
        return Said("info", line)
    if re.search(r"(^|: )talus-[a-z-]+: warning: |^\S+: WARNING: ", line):
        return Said("warning", line)
    if re.match(r"make(\[\d+\])?: \*\*\* |\S*\.mk:\d+: \*\*\* |(\S+: )?talus-[a-z-]+: |new-site: ", line):
        return Said("error", line)
    return Said("info", line)


class Lines:
    """Puts the pieces that a process writes together to whole lines."""

    def __init__(self, take):
        self.take, self.rest = take, b""

    def add(self, piece):
        self.rest += bytes(piece)
        *whole, self.rest = self.rest.split(b"\n")
        for line in whole:
            self.take(line.decode("utf-8", "replace"))

    def end(self):
        if self.rest:
            self.take(self.rest.decode("utf-8", "replace"))
            self.rest = b""


def has_failed_runs(lines):
    """Whether make ended with an error only because runs failed: the rest is made, and says so."""
    return any(re.match(r"talus-batch: \d+ of \d+ runs? failed", line) for line in lines)


# --- their outputs --------------------------------------------------------------------------------

# Outputs of a goal that are shown, by name in the folder of the results; the last one lies on top.
SHOWN_OF_GOAL = {
    "terrain": ["trn.tif"], "blocks": ["blocks.gpkg"], "runout": ["thickness.tif", "runout.gpkg"],
    "maps": ["maps/*.tif"], "fence": ["change.tif", "fence.gpkg"], "hazard": ["hazard/*.tif", "hazard/hazard.gpkg"],
    "trace": ["sources/*.tif", "trace.gpkg"],
    "calibrate": ["calibrate.gpkg"],
    "stability": ["stability/blocks.gpkg"],
    "profile": ["profile/profile.gpkg"],
    "fence-search": ["fence_search.gpkg"],
    "variants": ["variant/*/maps/compare.tif"],
    "report": ["variant/*/maps/compare.tif"],
    "all": ["trn.tif", "variant/*/maps/compare.tif", "maps/*.tif", "blocks.gpkg", "runout.gpkg", "fence.gpkg"],
}


def measures_of(results):
    """Measures of the site when make last read it; others have left results, too."""
    try:
        with open(os.path.join(results, "stages", "site.mk"), encoding="utf-8") as file:
            found = re.search(r"^SITE_MEASURES :=(.*)$", file.read(), re.MULTILINE)
    except (OSError, ValueError):
        return []
    return found[1].split() if found else []


def measure_of(path):
    """Name of the measure whose map a file is; "" where it is another file."""
    found = re.search(r"[/\\]variant[/\\]([^/\\]+)[/\\]maps[/\\]compare\.tif$", path)
    return found[1] if found else ""


def files_to_show(results, goal):
    """Files of a folder of results that a goal made."""
    import glob
    measures = ["", *measures_of(results)]
    return [file for pattern in SHOWN_OF_GOAL.get(goal, [])
            for file in sorted(glob.glob(os.path.join(glob.escape(results), pattern))) if measure_of(file) in measures]


def layer_name(raster):
    """Name of its layer; maps of measures all have one name, in folders of their own."""
    measure = measure_of(raster)
    return "site minus " + measure if measure else os.path.splitext(os.path.basename(raster))[0]
