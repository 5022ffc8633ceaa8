"""The plug-in without QGIS: options, command lines, messages, and that it can be imported anywhere.

usage: units.py PLUGIN_FOLDER (the folder `talus`); the tools are on the search path.
"""
import importlib
import os
import re
import sys
import tempfile
import types
import unittest

plugin_folder = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.dirname(plugin_folder))
sys.dont_write_bytecode = True


class Stub:
    """Replaces any class of QGIS: takes everything, keeps its arguments."""

    TypeFile, Double, Integer, Folder, FlagAdvanced, FlagCanCancel = range(6)

    def __init__(self, *args, **kwargs):
        self.args, self.kwargs = args, kwargs

    def flags(self):
        return 0

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *args, **kwargs: None


class StubModule(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        found = type(name, (Exception if name.endswith("Exception") else Stub,), {})
        setattr(self, name, found)
        return found


tools = importlib.import_module("talus.tools")


def with_stubs(test):
    def run(self):
        names = ["qgis", "qgis.core", "qgis.PyQt", "qgis.PyQt.QtGui"]
        sys.modules.update({name: StubModule(name) for name in names})
        try:
            test(self)
        finally:
            for name in names + [n for n in sys.modules if n.startswith("talus.") and n != "talus.tools"]:
                del sys.modules[name]
    return run


def option(key, role="value", **more):
    return {"key": key, "spelling": "--" + key, "positional": False, "role": role, "type": "text",
            "required": False, "several": False, "help": "", **more}


class Descriptions(unittest.TestCase):
    def test_each_tool_describes_itself(self):
        found = tools.descriptions()
        self.assertEqual([t["tool"] for t in found], tools.tool_names())
        self.assertGreaterEqual(len(found), 1)
        for tool in found:
            for entry in tool["options"] + tool["common_options"]:
                self.assertIn(entry["role"], ("input", "output", "output_folder", "value", "flag"), tool["tool"])
                self.assertTrue(entry["help"], tool["tool"] + " " + entry["key"])
                self.assertEqual(entry["positional"], not entry["spelling"].startswith("-"))

    def test_groups_name_tools_that_there_are(self):
        names = [name for group in tools.GROUPS.values() for name in group]
        self.assertEqual(len(names), len(set(names)))
        self.assertFalse({"talus-" + name for name in names} - set(tools.tool_names()))

    def test_inputs_and_outputs_are_known_as_such(self):
        of = {o["key"]: o for o in tools.description("talus-site")["options"]}
        self.assertEqual((of["site"]["role"], of["site"]["positional"]), ("input", True))
        self.assertEqual(of["out"]["role"], "output_folder")
        self.assertEqual(of["new-layers"]["role"], "output")
        self.assertTrue(of["set"]["several"])

    def test_choices_and_defaults_are_those_of_the_tool(self):
        of = {o["key"]: o for o in tools.description("talus-site")["common_options"]}
        self.assertEqual(of["messages"]["choices"], ["text", "json"])
        self.assertEqual(of["messages"]["default"], "text")

    def test_what_cannot_describe_itself_is_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("talus-old", "#!/bin/sh\nexit 2\n"), ("talus-bad", "#!/bin/sh\necho '[1]'\n")):
                path = os.path.join(folder, name)
                with open(path, "w") as file:
                    file.write(text)
                os.chmod(path, 0o755)
            self.assertEqual(tools.tool_names(folder), ["talus-bad", "talus-old"])
            self.assertEqual(tools.descriptions(folder), [])

    def test_without_tools_there_is_nothing_and_no_error(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(tools.descriptions(folder), [])
            self.assertEqual(tools.goals(folder), [])
            self.assertEqual(tools.tool_path("talus-site", folder), "")

    def test_the_cache_is_asked_until_a_tool_is_another(self):
        with tempfile.TemporaryDirectory() as folder:
            tool, cache = os.path.join(folder, "talus-x"), os.path.join(folder, "cache.json")

            def write(purpose):
                with open(tool, "w") as file:
                    file.write("#!/bin/sh\necho asked >>%s/asked\necho '{\"tool\": \"talus-x\", \"purpose\": \"%s\", "
                               "\"options\": []}'\n" % (folder, purpose))
                os.chmod(tool, 0o755)

            write("a")
            for _ in range(3):
                self.assertEqual(tools.descriptions(folder, cache)[0]["purpose"], "a")
            write("another")
            self.assertEqual(tools.descriptions(folder, cache)[0]["purpose"], "another")
            with open(os.path.join(folder, "asked")) as file:
                self.assertEqual(len(file.readlines()), 2)
            with open(cache, "w") as file:
                file.write("{broken")
            self.assertEqual(tools.descriptions(folder, cache)[0]["purpose"], "another")


class Goals(unittest.TestCase):
    def test_goals_are_those_of_make_help(self):
        found = {goal.name: goal.purpose for goal in tools.goals()}
        self.assertIn("everything", found["all"])
        for name in ("terrain", "blocks", "check", "runs", "runout", "maps", "fence", "hazard", "trace", "report",
                     "clean"):
            self.assertIn(name, found)
        self.assertFalse(tools.GOALS_NOT_SHOWN & set(found))

    def test_files_to_show_know_only_goals_of_make(self):
        self.assertFalse(set(tools.SHOWN_OF_GOAL) - {goal.name for goal in tools.goals()})


class Elsewhere(unittest.TestCase):
    """Tools in WSL or in a container; here `env` starts them, which is as good a command as any."""

    def setUp(self):
        self.here = (tools.tool_names(), tools.pipelines_folder(), tools.goals())
        tools.before = ["env", "ELSEWHERE=1"]

    def tearDown(self):
        tools.before = []

    def test_tools_and_goals_are_asked_for_there(self):
        self.assertEqual((tools.tool_names(), tools.pipelines_folder(), tools.goals()), self.here)
        self.assertEqual(tools.tool_path("talus-site"), "talus-site")
        self.assertEqual(tools.tool_path("talus-nothing"), "")
        self.assertTrue(tools.description("talus-site")["options"])

    def test_nothing_is_offered_where_the_command_is_not_there(self):
        tools.before = ["/no/such/command"]
        self.assertEqual((tools.tool_names(), tools.goals(), tools.tool_path("talus-site")), ([], [], ""))

    def test_paths_of_windows_are_those_of_the_place(self):
        for word, there in (("C:\\data\\a b.tif", "/mnt/c/data/a b.tif"), ("--out=D:/x\\y", "--out=/mnt/d/x/y"),
                            ("--set=fence.a.file=C:\\f.gpkg|layername=b", "--set=fence.a.file=/mnt/c/f.gpkg|layername=b"),
                            ("/data/a", "/data/a"), ("--crs=EPSG:2056", "--crs=EPSG:2056"), ("RUNS=5", "RUNS=5")):
            self.assertEqual(tools.inside(word), there)
        self.assertEqual(tools.started(["make", "-C", "C:\\s"]), ["env", "ELSEWHERE=1", "make", "-C", "/mnt/c/s"])
        tools.before = []
        self.assertEqual(tools.started(["make", "-C", "C:\\s"]), ["make", "-C", "C:\\s"])


class CommandLines(unittest.TestCase):
    tool = {"tool": "talus-x", "common_options": [option("overwrite", "flag"), option("db")], "options": [
        option("run", "input", positional=True, spelling="run", several=True),
        option("out", "output", help="maps (GeoTIFF; style beside it)"),
        option("set", several=True), option("cell-size-m", type="number", default="5"),
        option("png", "flag"), option("resume", "flag")]}

    def words(self, **values):
        return tools.command_line(self.tool, {k.replace("_", "-"): v for k, v in values.items()})[1]

    def test_values_are_words_and_never_parted(self):
        words = self.words(run=["a b.h5", "-c.h5"], set=["a.b=1", "x.y=-2 3"], out="o'ut.tif", png=True)
        self.assertEqual(words, ["--out=o'ut.tif", "--set=a.b=1", "--set=x.y=-2 3", "--png", "--progress=json",
                                 "--messages=json", "--overwrite", "--", "a b.h5", "-c.h5"])

    def test_a_default_is_not_given_again(self):
        self.assertNotIn("--cell-size-m", " ".join(self.words(cell_size_m=5.0, png=False)))
        self.assertIn("--cell-size-m=2.5", self.words(cell_size_m=2.5))
        self.assertIn("--cell-size-m=0.1", self.words(cell_size_m=0.1))
        self.assertFalse(tools.is_given(option("a"), None) or tools.is_given(option("a"), ""))
        self.assertTrue(tools.is_given(option("a", type="number"), 0.0))

    def test_what_is_resumed_is_not_overwritten(self):
        self.assertIn("--overwrite", self.words())
        self.assertNotIn("--overwrite", self.words(resume=True))

    def test_the_extension_is_that_of_the_format_in_the_help(self):
        for help_text, extension in (("maps (GeoTIFF; style beside it)", "tif"), ("a (b) c (JSON)", "json"),
                                     ("layers (GeoPackage)", "gpkg"), ("run (HDF5); not for --plan", "h5"),
                                     ("project (QGZ), relative", "qgz"), ("report (HTML, one file)", "html"),
                                     ("a folder", "")):
            self.assertEqual(tools.extension_of(option("a", help=help_text)), extension)

    def test_maps_may_be_picked_from_the_project(self):
        for help_text, is_layer in (("contour lines (any vector source that GDAL reads)", True),
                                    ("terrain of the runs (GeoTIFF of talus-trn)", True),
                                    ("TIN (PLY, LandXML), or an elevation raster", False),
                                    ("list of blocks on the slope (CSV)", False), ("block set (talus-blocks)", False)):
            self.assertEqual(tools.is_layer(option("a", "input", help=help_text)), is_layer, help_text)

    def test_make_gets_the_folder_of_the_tools(self):
        program, words = tools.goal_command("/s", "all", ["RUNS=5", ""], 3, "/opt/t")
        self.assertEqual([program] + words, ["env", "TALUS_PROGRESS=json", "make", "-C", "/s", "-j3",
                                             "--no-print-directory", "all", "BIN=/opt/t/", "RUNS=5"])
        there = os.path.dirname(tools.tool_path("talus-site"))
        self.assertIn("BIN=" + there + "/", tools.goal_command("/s", "all", [])[1])


class Messages(unittest.TestCase):
    def test_each_line_is_what_it_means(self):
        for line, expected in (
                ('{"progress":0.25,"eta_s":3}', ("progress", 25.0)), ('{"label":"run_2","progress":0.5}', None),
                ('{"level":"warning","tool":"talus-x","label":"run_2","text":"a"}', ("warning", "run_2: a")),
                ('{"level":"hint","tool":"talus-x","text":"b"}', ("hint", "b")), ("{broken", ("info", "{broken")),
                ("", None),
                ("talus-trn: warning: c", ("warning", "talus-trn: warning: c")),
                ("run_1: talus-dda: no block", ("error", "run_1: talus-dda: no block")),
                ("make: *** [a.mk:3: x] Error 1", ("error", "make: *** [a.mk:3: x] Error 1")),
                ("inputs.mk:20: *** talus-dda cannot be found. Stop.",
                 ("error", "inputs.mk:20: *** talus-dda cannot be found. Stop.")),
                ("terrain: a -> b", ("info", "terrain: a -> b"))):
            found = tools.said(line)
            self.assertEqual(None if found is None else tuple(found), expected, line)

    def test_pieces_become_lines(self):
        lines = []
        take = tools.Lines(lines.append)
        for piece in (b"a\nb", b"", b"c\n\xc3", b"\xa9\nend"):
            take.add(piece)
        take.end()
        self.assertEqual(lines, ["a", "bc", "é", "end"])

    def test_failed_runs_are_told_from_other_errors(self):
        self.assertTrue(tools.has_failed_runs(["a", "talus-batch: 2 of 12 runs failed:"]))
        self.assertFalse(tools.has_failed_runs(["make: *** [x] Error 1"]))


class Loading(unittest.TestCase):
    @with_stubs
    def test_all_modules_load_and_every_option_gets_a_parameter(self):
        algorithm = importlib.import_module("talus.tool_algorithm")
        importlib.import_module("talus.provider")
        importlib.import_module("talus").classFactory(None)
        n = 0
        for tool in tools.descriptions():
            names = [tools.parameter_name(o) for o in tools.shown_options(tool)]
            self.assertEqual(len(names), len(set(names)), tool["tool"])
            for entry in tools.shown_options(tool):
                parameter = algorithm.parameter_of(entry)
                self.assertEqual(parameter.args[0], tools.parameter_name(entry))
                n += 1
        self.assertGreater(n, 0)

    def test_nothing_but_python_and_qgis_is_imported(self):
        allowed = {"functools", "glob", "json", "os", "re", "shlex", "shutil", "subprocess", "collections", "qgis", "processing", ""}
        for name in os.listdir(plugin_folder):
            if not name.endswith(".py"):
                continue
            with open(os.path.join(plugin_folder, name)) as file:
                for found in re.finditer(r"^\s*(?:from|import)\s+([\w.]*)", file.read(), re.MULTILINE):
                    self.assertIn(found.group(1).split(".")[0], allowed, name)

    def test_the_version_is_that_of_the_tools(self):
        with open(os.path.join(plugin_folder, "metadata.txt")) as file:
            version = re.search(r"^version=(.*)$", file.read(), re.MULTILINE).group(1)
        self.assertTrue(tools.description("talus-site")["version"].startswith(version))


if __name__ == "__main__":
    unittest.main()
