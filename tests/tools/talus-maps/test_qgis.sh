# QGIS opens every raster and vector layer with the style beside it, and draws something.
mkdir -m 700 runtime
export QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR="$PWD/runtime"
for python in python3 /usr/bin/python3; do
  "$python" -c 'import qgis.core' 2>/dev/null && break
  python=
done
[ -n "$python" ] || skip 'no Python bindings of QGIS (python3-qgis)'
mkdir with
run-probe . 3
run-probe with 3 standing=1 seed=1
expect 0 talus-maps run_0.h5 run_1.h5 run_2.h5 --trn slope.tif -o layers --min-passages 2
expect 0 talus-runout run_0.h5 run_1.h5 --trn slope.tif -o layers/runout.gpkg --thickness layers/thickness.tif
expect 0 talus-fence site.toml with/run_0.h5 with/run_1.h5 --without run_0.h5 run_1.h5 --trn slope.tif -o layers/fence.gpkg --change layers/change.tif
cat >check.py <<'PY'
import glob
import os
from osgeo import gdal, ogr
from qgis.core import (QgsApplication, QgsMapRendererCustomPainterJob, QgsMapSettings,
                       QgsRasterLayer, QgsVectorLayer)
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor, QImage, QPainter

application = QgsApplication([], False)
application.initQgis()


def draws(layer):
    settings = QgsMapSettings()
    settings.setLayers([layer])
    settings.setExtent(layer.extent().buffered(2))
    settings.setDestinationCrs(layer.crs())
    settings.setBackgroundColor(QColor(0, 0, 0, 0))
    settings.setOutputSize(QSize(100, 100))
    image = QImage(100, 100, QImage.Format_ARGB32)
    image.fill(0)
    painter = QPainter(image)
    job = QgsMapRendererCustomPainterJob(settings, painter)
    job.renderSynchronously()
    painter.end()
    return any(image.pixel(x, y) >> 24 for x in range(100) for y in range(100))


rasters = sorted(glob.glob('layers/*.tif'))
assert len(rasters) == 12, rasters
for path in rasters:
    layer = QgsRasterLayer(path, path)
    assert layer.isValid() and layer.crs().authid() == 'EPSG:31254', path
    message, is_styled = layer.loadDefaultStyle()
    assert is_styled, (path, message)
    renderer = layer.renderer()
    assert renderer.type() == 'singlebandpseudocolor', (path, renderer.type())
    file = gdal.Open(path)  # a band lives as long as its file
    shown = file.GetMetadataItem('SHOWN_BAND')
    band = file.GetRasterBand(renderer.band()).GetDescription()
    assert band == shown, (path, band, shown)
    assert len(renderer.shader().rasterShaderFunction().colorRampItemList()) >= 8, path
    # zero is transparent: equal runs on both sides change nothing, no box has 300 kJ
    is_zero = path in ('layers/change.tif', 'layers/exceedance.tif')
    assert draws(layer) != is_zero, path
for path in ('layers/runout.gpkg', 'layers/fence.gpkg'):
    source = ogr.Open(path)
    names = [source.GetLayer(i).GetName() for i in range(source.GetLayerCount())]
    names.remove('layer_styles')
    assert names
    for name in names:
        layer = QgsVectorLayer(path + '|layername=' + name, name, 'ogr')
        assert layer.isValid() and layer.featureCount() > 0, (path, name)
        message, is_styled = layer.loadDefaultStyle()
        assert is_styled, (path, name, message)
        assert draws(layer), (path, name)
print('QGIS opened %d rasters' % len(rasters))
os._exit(0)  # QGIS may crash while it tidies up
PY
"$python" check.py || fail 'QGIS does not open a layer with its style'
