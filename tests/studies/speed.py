#!/usr/bin/env python3
"""Speed of single rocks and of the terrain, whole tools, CPU times of one core.

Single rocks: 0.3 m3 each, released every 5 m over the source of gschnitz_gar, median of three: with all outputs
written, without passages, and with everything that the plan leaves out. Beside GDAL: a million points of contours to nine million nodes, in one thread.
"""
import json
import re
import resource

from study import SOURCE, Study

STUDY = Study(__file__, __doc__)


def cpu(study, *words):
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    before = used()
    study.run(*words)
    return used() - before


@STUDY.part("rocks", 20)
def rocks(study):
    study.need_data("scenarios/gschnitz_gar.gpkg")
    study.make(SOURCE / "sample_sites/gschnitz_gar", f"OUT={study.out / 'site'}", "terrain")
    (study.out / "site.toml").write_text(f'''[site]
name = "gschnitz_gar"
crs = "EPSG:31287"
[ground.slope]
friction_deg = 32
cor = 0.35
[rockfall.rock]
polygon_file = "{study.data}/scenarios/gschnitz_gar.gpkg|layername=release"
shape = "rock"
size_m = [1.2, 1.0, 0.8]
release_spacing_m = 5
height_above_ground_m = 0.5
[solver]
duration_s = 120
max_lost_share = 1
[output]
frame_interval_s = 10
''')
    study.run("talus-blocks", "site.toml", "--trn", "site/trn.tif", "-o", "blocks.h5", "--overwrite", "--no-db", "-q")
    for name, words in (("all outputs", []), ("without passages", ["--set", "output.passages=false"]), ("full plan", ["--plan=full"])):
        said = sorted((json.loads(study.run("talus-dda", "site.toml", "--trn", "site/trn.tif", "--blocks", "blocks.h5", "-o", "run.h5",
                                            "--overwrite", "--no-db", "-q", "--json", *words)) for _ in range(3)),
                      key=lambda run: run["cpu_time_s"])[1]
        study.row("rocks", name, {"rocks": said["n_blocks"], "CPU s": f"{said['cpu_time_s']:.2f}",
                                  "rocks a CPU second": f"{said['n_blocks'] / said['cpu_time_s']:.0f}"})


@STUDY.part("gdal_grid", 80)
def gdal_grid(study):
    for name in ("fine.tif", "contours.gpkg", "grid.tif"):
        (study.out / name).unlink(missing_ok=True)
    study.run("gdalwarp", "-q", "-r", "cubicspline", "-ts", 1740, 1220, "-ot", "Float32",
              SOURCE / "sample_sites/maungawhau/volcano.asc", "fine.tif")
    study.run("gdal_contour", "-q", "-3d", "-a", "ELEV", "-i", 0.34, "fine.tif", "contours.gpkg")
    kept = ["--overwrite", "--no-db", "-q"]
    mended = cpu(study, "talus-tin", "contours.gpkg", "--crs", "none", "-o", "mended.ply", *kept)
    plain = cpu(study, "talus-tin", "contours.gpkg", "--crs", "none", "-o", "tin.ply", "--flat", "keep", *kept)
    nodes = cpu(study, "talus-trn", "tin.ply", "-o", "trn.tif", "--cell-size-m", 0.242, *kept)
    info = study.run("gdalinfo", "trn.tif")
    size = re.search(r"Size is (\d+), (\d+)", info).groups()
    west, north = re.search(r"Upper Left *\( *([\d.-]+), *([\d.-]+)\)", info).groups()
    east, south = re.search(r"Lower Right *\( *([\d.-]+), *([\d.-]+)\)", info).groups()
    other = cpu(study, "gdal_grid", "-q", "-a", "linear:radius=0:nodata=-9999", "-zfield", "ELEV", "-txe", west, east, "-tye",
                north, south, "-outsize", *size, "-ot", "Float64", "--config", "GDAL_NUM_THREADS", 1, "contours.gpkg", "grid.tif")
    study.row("gdal_grid", "a million points to nine million nodes", {
        "talus-tin, CPU s": f"{mended:.1f}", "talus-tin --flat keep": f"{plain:.1f}", "talus-trn": f"{nodes:.1f}",
        "gdal_grid": f"{other:.1f}", "gdal_grid over Talus": f"{other / (mended + nodes):.1f}"})


if __name__ == "__main__":
    STUDY.main()
