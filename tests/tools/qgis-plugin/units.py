"""The plug-in without QGIS: options, command lines, messages, and that it can be imported anywhere.

usage: units.py PLUGIN_FOLDER (the folder `talus`); the tools are on the search path.
"""
import importlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

plugin_folder = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.dirname(plugin_folder))
sys.dont_write_bytecode = True


class Stub:
    """Replaces any class of QGIS: takes everything, keeps its arguments."""

    TypeFile, TypeVectorLine, Double, Integer, Folder, FlagAdvanced, FlagCanCancel = range(7)

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
site_file = importlib.import_module("talus.site_file")


def with_stubs(test):
    def run(self):
        names = ["qgis", "qgis.core", "qgis.PyQt", "qgis.PyQt.QtGui"]
        sys.modules.update({name: StubModule(name) for name in names})
        try:
            test(self)
        finally:
            own = [n for n in sys.modules if n.startswith("talus.") and n not in ("talus.tools", "talus.site_file")]
            for name in names + own:
                del sys.modules[name]
            for name in own:
                delattr(sys.modules["talus"], name.removeprefix("talus."))
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


class SiteFile(unittest.TestCase):
    site = """# the slope
[site]
name = "a [b] # c"
[fence.net]
line = [[1, 2],  # left
  [3, 4]]
[variant.'net 6'.fence.net]  # of May
height_m = 5
# it is wide
capacity_kj = 500 # kJ

# the cut
[variant.cut]
without = ["forest.wood"]
[ variant . "net 6" ]
cost = 1
"""

    def test_a_text_is_its_statements(self):
        parts = site_file.statements(self.site)
        self.assertEqual("".join(parts), self.site)
        self.assertIn("line = [[1, 2],  # left\n  [3, 4]]\n", parts)
        self.assertEqual([h for h in map(site_file.heading_of, parts) if h is not None],
                         [["site"], ["fence", "net"], ["variant", "net 6", "fence", "net"], ["variant", "cut"],
                          ["variant", "net 6"]])
        for text in ("", "a = 1", 'a = """\n[b]\n"""\n[c]\n', "a = \'\'\'\n[b]\n\'\'\'\n[c]\n", "a = '['\n[c]",
                     "# don't [\n[c]"):
            self.assertEqual("".join(site_file.statements(text)), text)
            headings = [h for h in map(site_file.heading_of, site_file.statements(text)) if h is not None]
            self.assertEqual(headings, [["c"]] if "[c]" in text else [], text)

    def test_only_the_lines_of_the_measure_change(self):
        section = ["[variant.'net 6']", "cost = 2"]
        before = self.site.split("[variant.'net 6'")[0]
        after = "\n# the cut\n[variant.cut]\nwithout = [\"forest.wood\"]\n"
        changed = site_file.with_measure(self.site, "net 6", section)
        self.assertEqual(changed, before + "[variant.'net 6']\n# it is wide\ncost = 2\n" + after)
        self.assertEqual(site_file.with_measure(changed, "net 6", section), changed)
        self.assertEqual(site_file.with_measure(self.site, "new", section),
                         self.site + "\n" + "\n".join(section) + "\n")
        self.assertEqual(site_file.with_measure("a = 1", "new", ["b"]), "a = 1\n\nb\n")
        self.assertEqual(site_file.with_measure("a = 1\r\n", "new", ["b"]), "a = 1\r\n\r\nb\r\n")

    def test_a_section_is_toml(self):
        values = [(["cost"], 90000.0), (["without"], ['forest."wood"', "rockfall.a"]),
                  (["fence", "a b", "file"], "é\\\n"),
                  (["fence", "net", "height_m"], 4.5), (["dam", "net", "height_m"], None)]
        self.assertEqual(site_file.measure_section("net", values, ["x.y = [", "[1, 2]]"]),
                         ["[variant.net]", "cost = 90000", 'without = ["forest.\\"wood\\"", "rockfall.a"]',
                          'fence."a b".file = "é\\\\\\n"', "fence.net.height_m = 4.5", "x.y = [", "[1, 2]]"])
        with self.assertRaisesRegex(ValueError, "begins another section"):
            site_file.measure_section("net", [], ["a = 1", "[solver]"])

    def test_files_are_named_from_the_folder_of_the_site(self):
        for file, words in (("/s/a b.gpkg|layername=x", "a b.gpkg|layername=x"), ("/s/d/a.shp", "d/a.shp"),
                            ("/s2/a.shp", "/s2/a.shp")):
            self.assertEqual(site_file.file_words("/s", file), words)

    def test_maps_of_the_measures_of_now_are_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("new", "earlier"):
                os.makedirs(os.path.join(folder, "variant", name, "maps"))
                open(os.path.join(folder, "variant", name, "maps", "compare.tif"), "w").close()
            self.assertEqual(tools.files_to_show(folder, "report"), [])
            os.makedirs(os.path.join(folder, "stages"))
            with open(os.path.join(folder, "stages", "site.mk"), "w") as file:
                file.write("SITE_OBJECTS := yes\nSITE_MEASURES := new other\n")
            shown = [os.path.join(folder, "variant", "new", "maps", "compare.tif")]
            for goal, files in (("report", shown), ("variants", shown), ("maps", [])):
                self.assertEqual(tools.files_to_show(folder, goal), files)
            self.assertEqual(tools.layer_name(shown[0]), "site minus new")
            self.assertEqual(tools.layer_name("/out/maps/compare.tif"), "compare")


class Process:
    """QgsBlockingProcess without QGIS."""

    def __init__(self, program, arguments):
        self.words = [program] + arguments

    def setStdOutHandler(self, take):
        self.take_out = take

    def setStdErrHandler(self, take):
        self.take_err = take

    def run(self, feedback):
        done = subprocess.run(self.words, capture_output=True, check=False)
        self.take_out(done.stdout)
        self.take_err(done.stderr)
        return done.returncode

    def processError(self):
        return 5


class Measures(unittest.TestCase):
    """Measures of a sample site, by the tools themselves."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.site, source = folder.name, os.path.dirname(os.path.dirname(plugin_folder))
        shutil.copy(os.path.join(source, "sample_sites", "designed", "contours.gpkg"), self.site)
        with open(os.path.join(source, "sample_sites", "designed", "site.toml")) as file:
            self.text = re.sub("(?m)^duration_s = .*", "duration_s = 0.5", file.read())
        self.write("site.toml", self.text)
        self.write("Makefile", "include %s/pipelines/site.mk\n" % source)
        self.write("line.geojson", '{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": '
                   '"EPSG:32633"}}, "features": [{"type": "Feature", "properties": {}, "geometry": {"type": '
                   '"LineString", "coordinates": [[500060, 5200190], [500164, 5200190]]}}]}')

    def path(self, name):
        return os.path.join(self.site, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)

    def text_now(self):
        with open(self.path("site.toml")) as file:
            return file.read()

    def run_algorithm(self, algorithm, is_canceled=False, temporary="/no/such/folder", **values):
        """Results, as QGIS would have them."""
        running = importlib.import_module("talus.running")
        running.QgsBlockingProcess = Process
        self.refusal, self.shown = running.QgsProcessingException, []
        running.show = lambda file, context: self.shown.append(os.path.relpath(file, self.site))
        feedback = Stub()
        feedback.isCanceled = lambda: is_canceled
        algorithm.parameterAsString = algorithm.parameterAsFile = lambda of, name, context: of.get(name) or ""
        algorithm.parameterAsDouble = lambda of, name, context: float(of[name])
        algorithm.parameterAsInt = lambda of, name, context: int(of[name])
        sys.modules["talus.measure_algorithm"].QgsProcessingUtils.tempFolder = lambda: temporary
        return algorithm.processAlgorithm({"SITE": self.site, **values}, Stub(), feedback)

    @with_stubs
    def test_what_passes_is_written_and_what_does_not_leaves_no_trace(self):
        algorithm = importlib.import_module("talus.measure_algorithm").MeasureAlgorithm()
        algorithm.initAlgorithm()
        with self.assertRaises(Exception) as refused:
            self.run_algorithm(algorithm, NAME="low", OTHER="fence.vally.height_m = 3")
        self.assertIn("did you mean valley?", str(refused.exception))
        with self.assertRaises(Exception) as refused:
            self.run_algorithm(algorithm, NAME="low",
                               OTHER="fence.valley.line = [[500060, 5200150], [500964, 5200150]]")
        self.assertIn("leaves the known terrain", str(refused.exception))
        self.assertIsInstance(refused.exception, self.refusal)
        with self.assertRaisesRegex(Exception, "make it permanent"):
            self.run_algorithm(algorithm, temporary=self.site, NAME="low", FENCE_LINE=self.path("line.geojson"))
        self.assertEqual(self.run_algorithm(algorithm, is_canceled=True, NAME="low", COST=1), {})
        self.assertEqual(self.text_now(), self.text)

        line = self.path("line.geojson")
        found = self.run_algorithm(algorithm, NAME="low", COST=90000, FENCE_LINE=line, FENCE_HEIGHT_M=3,
                                   FENCE_CAPACITY_KJ=500, WITHOUT="fence.valley\n", DAM_LINE=line)
        section = ('\n[variant.low]\ncost = 90000\nwithout = ["fence.valley"]\nfence.low.file = "line.geojson"\n'
                   'fence.low.height_m = 3\nfence.low.capacity_kj = 500\ndam.low.file = "line.geojson"\n')
        self.assertEqual(self.text_now(), self.text + section)
        with open(found["CHECK"]) as file:
            self.assertIn("fence low", file.read())
        self.assertFalse([name for name in os.listdir(self.site) if name.startswith("site.toml.")])

        self.run_algorithm(algorithm, NAME="low", FENCE="valley", FENCE_HEIGHT_M=3.5)
        self.assertEqual(self.text_now(), self.text + "\n[variant.low]\nfence.valley.height_m = 3.5\n")

        report = importlib.import_module("talus.goal_algorithm").GoalAlgorithm(tools.Goal("report", "all of it"))
        found = self.run_algorithm(report, JOBS=1, VARIABLES="RUNS=1")
        self.assertEqual(self.shown, [os.path.join("out", "variant", "low", "maps", "compare.tif")])
        with open(found["REPORT"]) as file:
            self.assertIn("variant/low/report.html", file.read())


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
