#!/bin/sh
# look_at_report.sh OUT [FOLDER]: pictures of the report and the QGIS project in OUT (a site's results):
# desktop, narrow, the animation while it plays, the printed pages, the project's map and layout. Fails
# where the browser's console holds an error, the viewer does not play, or a layer is not valid. Needs
# chromium, and for the project qgis and python3-qgis. Not part of the normal tests.
set -eu
out=$(realpath "$1") shots=${2:-$(mktemp -d)}
mkdir -p "$shots"
browse() {
  chromium --headless=new --no-sandbox --disable-gpu --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
    --hide-scrollbars --enable-logging=stderr "$@" 2>>"$shots/console.log"
}
: >"$shots/console.log"
browse --virtual-time-budget=6000 --window-size=1280,9000 --screenshot="$shots/desktop.png" "file://$out/report.html"
browse --virtual-time-budget=6000 --window-size=500,9000 --screenshot="$shots/narrow.png" "file://$out/report.html"
browse --virtual-time-budget=6000 --no-pdf-header-footer --print-to-pdf="$shots/print.pdf" "file://$out/report.html"

# The same page with a hand that plays, and writes the outcome into its title.
{
  cat "$out/report.html"
  cat <<'END'
<script>
talusView();
const view = window.talus, start = view.state().now;
view.play();
setTimeout(() => {
  const state = view.state();
  const gl = document.querySelector('#viewer canvas').getContext('webgl2'), pixel = new Uint8Array(4);
  gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  document.body.dataset.played = state.now > start && gl.getError() === 0 && pixel[3] === 255 ? 'yes' : 'no';
}, 3000);
</script>
END
} >"$shots/playing.html"
browse --virtual-time-budget=12000 --window-size=1280,1000 --dump-dom "file://$shots/playing.html" >"$shots/dom.html"
grep -q 'data-played="yes"' "$shots/dom.html" || { echo "the viewer did not play" >&2; exit 1; }
if grep -E 'CONSOLE.*(Error|error|Failed)' "$shots/console.log"; then echo "the console holds errors" >&2; exit 1; fi

if python3 -c 'import qgis.core' 2>/dev/null || /usr/bin/python3 -c 'import qgis.core' 2>/dev/null; then
  QT_QPA_PLATFORM=offscreen HOME=$shots XDG_RUNTIME_DIR=$shots /usr/bin/python3 - "$out/site.qgz" "$shots" <<'END'
import sys
from qgis.core import (QgsApplication, QgsLayoutExporter, QgsProject)
application = QgsApplication([], False)
application.initQgis()
project = QgsProject.instance()
assert project.read(sys.argv[1]), project.error()
wrong = [layer.name() for layer in project.mapLayers().values() if not layer.isValid()]
assert not wrong, f"not valid: {wrong}"
print(f"{len(project.mapLayers())} layers, all valid; CRS {project.crs().authid()}")
exporter = QgsLayoutExporter(project.layoutManager().layoutByName("Map"))
settings = QgsLayoutExporter.ImageExportSettings()
settings.dpi = 100
assert exporter.exportToImage(f"{sys.argv[2]}/layout.png", settings) == QgsLayoutExporter.Success
del exporter
project.clear()
application.exitQgis()
END
else
  echo "no QGIS here: the project was not opened"
fi
echo "look at $shots/*.png and $shots/print.pdf"
