# QGIS opens the project: layers, styles a band, aliases, abstracts, and a layout that it draws.
mkdir -m 700 runtime
export QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR="$PWD/runtime"
for python in python3 /usr/bin/python3; do
  "$python" -c 'import qgis.core' 2>/dev/null && break
  python=
done
[ -n "$python" ] || skip 'no Python bindings of QGIS (python3-qgis)'
mkdir -p results/runs
run-probe results/runs 3 seed=1 'name=[% 6 * 7 %] on a slope whose name is so long that no title of one line can hold it'
mv results/runs/slope.tif results/trn.tif
mv results/runs/site.toml site.toml
expect 0 talus-runout results/runs/run_*.h5 --trn results/trn.tif -o results/runout.gpkg --json results/runout.json --no-db
expect 0 talus-maps results/runs/run_*.h5 --trn results/trn.tif -o results/maps --no-db
sed 's/size="297,210,mm"/size="420,297,mm"/; s/labelText="Signature:"/labelText="{title}"/' "$source_dir/tools/report/project.qgs" >office.qgs
for name in site office; do
  template=
  [ "$name" = site ] || template='--qgis-template office.qgs'
  # shellcheck disable=SC2086  # two words or none
  expect 0 talus-report site.toml --dir results -o "results/$name.html" --qgis "results/$name.qgz" --no-db $template
done
cat >check.py <<'PY'
import os
import sys
from qgis.core import (QgsApplication, QgsLayoutExporter, QgsLayoutItemLabel, QgsLayoutItemLegend,
                       QgsLayoutItemMap, QgsLayoutItemScaleBar, QgsLegendStyle, QgsProject, QgsVectorLayer)

application = QgsApplication([], False)
application.initQgis()
project = QgsProject.instance()


def items_of(kind):
    layout = project.layoutManager().layoutByName('Map')
    return {item.id(): item for item in layout.items() if isinstance(item, kind)}


for name, width in (('site', 297), ('office', 420)):
    assert project.read(f'results/{name}.qgz'), project.error()
    layers = {layer.name(): layer for layer in project.mapLayers().values()}
    assert all(layer.isValid() for layer in layers.values()), layers
    assert project.crs().authid() == 'EPSG:31254', project.crs()
    assert project.title().startswith('[ % 6 * 7 %] on a slope'), project.title()
    for layer in layers.values():
        assert 'run id ' in layer.metadata().abstract(), layer.name()
        if isinstance(layer, QgsVectorLayer):
            names = [layer.attributeDisplayName(i) for i in range(layer.fields().count())]
            assert not any('_' in words for words in names), names
    assert layers['Area that any block passed'].attributeDisplayName(1) == 'Area [m2]'
    speed = layers['Speed, largest [m/s]']
    assert 'centroid speed' in speed.metadata().abstract()
    styles = speed.styleManager()
    assert styles.currentStyle() == 'largest' and len(styles.styles()) >= 6, styles.styles()
    for style, band in (('median', 'velocity_p50'), ('95th percentile', 'velocity_p95'), ('largest', 'velocity_max')):
        assert styles.setCurrentStyle(style)
        assert speed.bandName(speed.renderer().band()).endswith(': ' + band), style
    paths = layers['Path to the toe, with L and H, farthest run']
    assert paths.featureCount() == 1, paths.featureCount()

    layout = project.layoutManager().layoutByName('Map')
    assert layout.pageCollection().page(0).pageSize().width() == width
    plan = items_of(QgsLayoutItemMap)['Map']
    assert plan.extent().intersects(layers['Hillshade'].extent())
    grid = plan.grids().grid(0)
    assert 2 <= plan.extent().width() / grid.intervalX() <= 11, grid.intervalX()
    bar = items_of(QgsLayoutItemScaleBar)['Scale']
    assert bar.linkedMap() == plan and bar.unitLabel() == 'm'
    legend = items_of(QgsLayoutItemLegend)['Legend']
    assert legend.style(QgsLegendStyle.Group).font().bold() and not legend.style(QgsLegendStyle.SymbolLabel).font().bold()
    labels = {key: item.currentText() for key, item in items_of(QgsLayoutItemLabel).items()}
    assert labels['Title'].startswith('[ % 6 * 7 %] on a slope') and '\n' in labels['Title'], labels
    assert labels['Statement'].startswith('run id ') and '\n' in labels['Statement'], labels
    assert labels['Scale number'].startswith('Scale 1 : ') and labels['Scale number'][10].isdigit(), labels
    assert labels['Signature'] == (project.title() if name == 'office' else 'Signature:'), labels
    settings = QgsLayoutExporter.ImageExportSettings()
    settings.dpi = 50
    assert QgsLayoutExporter(layout).exportToImage(f'{name}.png', settings) == QgsLayoutExporter.Success
print('QGIS opened both projects', flush=True)
os._exit(0)  # QGIS may crash while it tidies up
PY
"$python" check.py || fail 'QGIS does not show the project as it should'
