# The plug-in in QGIS without a window: the designed site gives the same bytes as make does, errors are the
# tool's own, cancel leaves a run that can be resumed, and without the tools it loads and says so.
. "$source_dir/tests/tools/pipeline/common.sh"
qgis=$(command -v qgis_process.bin || command -v qgis_process) || skip 'no QGIS here: qgis_process is missing (package qgis)'
for python in python3 /usr/bin/python3; do
  "$python" -c 'import qgis.core' 2>/dev/null && break
  python=
done
[ -n "$python" ] || skip 'no Python bindings of QGIS (python3-qgis)'
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
mkdir -m 700 runtime home
export QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR="$PWD/runtime" HOME="$PWD/home" PYTHONDONTWRITEBYTECODE=1
export QGIS_PLUGINPATH="$source_dir/qgis"
enabled=$("$qgis" plugins enable talus 2>&1) || skip "qgis_process does not run here: $(echo "$enabled" | tail -n 1)"

# without the tools
PATH=/usr/bin:/bin "$qgis" list >out 2>err || true
grep -q 'talus:new_site' out || fail "the plug-in does not load without the tools"
if grep -q 'talus:trn' out; then fail "tools are offered that are not there"; fi
expect 1 env PATH=/usr/bin:/bin "$qgis" run talus:new_site -- FOLDER="$work" NAME=a GROUND="$source_dir/sample_sites/designed/contours.gpkg"
grep -q "The tools of Talus were not found" out err || fail "it is not said that the tools are missing"

# all of them
expect 0 "$qgis" list
for tool in "${bin%%:*}"/talus-*; do
  [ -f "$tool" ] && [ -x "$tool" ] || continue
  id=$(echo "${tool##*/talus-}" | tr - _)
  [ "$id" = runs ] && id=runs_list
  grep -q "talus:$id	" out || fail "there is no algorithm for $tool"
done
for goal in all terrain blocks check runs runout maps fence fence_search hazard trace report clean; do
  grep -q "talus:make_$goal	" out || fail "there is no algorithm for make $goal"
done

# the whole site: as by make
site "by make"
site "by qgis"
made "by make" all
expect 0 "$qgis" run talus:make_all -- SITE="$PWD/by qgis" JOBS=2
grep -q 'REPORT:.*report.html' out || fail "the report is not named"
same "by make" "by qgis"

# a measure: written where make check accepts it, else the site file is as before
cp "by qgis/site.toml" before.toml
expect 1 "$qgis" run talus:measure -- SITE="$PWD/by qgis" NAME=low OTHER="fence.vally.height_m = 3"
cat out err | grep -q 'did you mean valley?' || fail "the words of the refusal are lost"
cmp before.toml "by qgis/site.toml" || fail "a measure that was refused is in the site file"
expect 0 "$qgis" run talus:measure -- SITE="$PWD/by qgis" NAME=low FENCE=valley FENCE_HEIGHT_M=3
printf '\n[variant.low]\nfence.valley.height_m = 3\n' >>before.toml
cmp before.toml "by qgis/site.toml" || fail "another section than that of the measure"

# one tool: its own words, and the same bytes as on a command line
expect 0 talus-trn "by make/out/tin.ply" -o here.tif --cell-size-m 8 --no-db
expect 0 "$qgis" run talus:trn -- SOURCE="$PWD/by make/out/tin.ply" CELL_SIZE_M=8 OUT="$PWD/there.tif"
[ "$(gdalinfo -checksum here.tif | grep Checksum)" = "$(gdalinfo -checksum there.tif | grep Checksum)" ] || fail "another terrain"
cmp here.tif there.tif || fail "other bytes"
expect 1 "$qgis" run talus:trn -- SOURCE="$PWD/by make/out/tin.ply" CELL_SIZE_M=-8 OUT="$PWD/bad.tif"
cat out err >both
grep -q 'cell-size-m' both || { cat both >&2; fail "the tool's own words are lost"; }
[ ! -e bad.tif ] || fail "an output of a tool that failed"
expect 1 "$qgis" run talus:make_all -- SITE="$PWD/by qgis" VARIABLES="RUNS"
cat out err | grep -q 'is not NAME=VALUE' || fail "a variable without a value"

# cancel, and resume; layers are loaded with their styles
cat >check.py <<'PY'
import os
import sys
from qgis.core import (QgsApplication, QgsProcessingContext, QgsProcessingFeedback, QgsProject, QgsProcessingUtils)

application = QgsApplication([], False)
application.initQgis()
sys.path.insert(0, os.environ["QGIS_PLUGINPATH"])
from talus import tools
from talus.provider import TalusProvider
provider = TalusProvider()
QgsApplication.processingRegistry().addProvider(provider)


class Feedback(QgsProcessingFeedback):
    def __init__(self):
        super().__init__(False)
        self.lines = []

    def pushInfo(self, text):
        self.lines.append(text)

    def reportError(self, text, fatalError=False):
        self.lines.append(text)


def run(name, values, cancel_at=None):
    algorithm = QgsApplication.processingRegistry().createAlgorithmById("talus:" + name)
    project, feedback = QgsProject(), Feedback()
    context = QgsProcessingContext()
    context.setProject(project)
    said = tools.said

    def listen(line):  # to the messages of make, the progress of single runs with it
        if cancel_at is not None and cancel_at in line:
            feedback.cancel()
        return said(line)

    tools.said = listen
    results, ok = algorithm.run(values, context, feedback)
    tools.said = said
    return results, ok, feedback, context


site = os.path.join(os.getcwd(), "long")
results, ok, feedback, context = run("make_runs", {"SITE": site, "JOBS": 1}, cancel_at="batch: runs")
assert feedback.isCanceled() and ok, feedback.lines
parts = [f for f in os.listdir(site + "/out/runs") if f.endswith(".h5.part")]
assert parts == ["run_1.h5.part"], (parts, feedback.lines)
results, ok, feedback, context = run("make_maps", {"SITE": site, "VARIABLES": "SEED=1 OUT=out"})
assert ok and results["EXIT_CODE"] == 0, feedback.lines
assert not [f for f in os.listdir(site + "/out/runs") if f.endswith(".part")]
assert feedback.progress() == 100, feedback.progress()
loaded = context.layersToLoadOnCompletion()
assert any(source.endswith("maps/velocity.tif") for source in loaded), list(loaded)
for source in loaded:
    layer = QgsProcessingUtils.mapLayerFromString(source, context, True)
    assert layer is not None and layer.isValid(), source
    context.layerToLoadOnCompletionDetails(source).postProcessor().postProcessLayer(layer, context, feedback)
    if source.endswith(".tif"):
        assert layer.renderer().type() == "singlebandpseudocolor", source
print("loaded %d layers" % len(loaded))
os._exit(0)  # QGIS may crash while it tidies up
PY
site long
sed -i 's/^duration_s = .*/duration_s = 4\ntime_step_s = 0.0005/' long/site.toml
made long check
expect 0 "$python" check.py
prints "loaded"
