#!/usr/bin/env python3
"""How wrong a terrain made from contours is: plain triangles beside mended ones, against the true elevation model.

Five derived sites; further contour maps made here from other elevation models by gdal_contour; and a genuine map,
whose truth is unknown: the share of flat triangles only. Nothing was fitted to a site. Needs gdal-bin.
"""
import json
import os

from study import Study

# contours, elevation model
SITES = {"salisbury crags 5 m": ("salisbury_crags_5m", "salisbury_crags_dsm_2m5.tif"),
         "gschnitz gar 10 m": ("gschnitz_gar_10m", "gschnitz_gar_5m.tif"),
         "gschnitz gar 20 m": ("gschnitz_gar_20m", "gschnitz_gar_5m.tif"),
         "lechtal kotcliff 5 m": ("lechtal_kotcliff_5m", "lechtal_kotcliff_5m.tif"),
         "lechtal kotdam 10 m": ("lechtal_kotdam_10m", "lechtal_kotdam_5m.tif")}
# elevation model, interval
FURTHER = {"holyrood park 10 m": ("holyrood_park_dsm_2m5.tif", 10), "serles 20 m": ("serles_10m.tif", 20),
           "serles 50 m": ("serles_10m.tif", 50), "arlberg 20 m": ("arlberg_wog_full_5m.tif", 20),
           "lechtal 10 m": ("lechtal_kot_full_5m.tif", 10), "lechtal 20 m": ("lechtal_kot_full_5m.tif", 20),
           "gschnitz full 10 m": ("gschnitz_gar_full_5m.tif", 10), "gschnitz full 20 m": ("gschnitz_gar_full_5m.tif", 20),
           "maungawhau 5 m": ("maungawhau_lidar_5m.tif", 5), "maungawhau 10 m": ("maungawhau_lidar_5m.tif", 10),
           "sainte helens 50 m": ("SainteHelens.dem", 50)}

STUDY = Study(__file__, __doc__)


def tin(study, contours, flat):
    study.run("talus-tin", contours, "-o", f"{flat}.ply", "--flat", flat, "--report", f"{flat}.json", "--overwrite", "--no-db", "-q")
    return json.loads((study.out / f"{flat}.json").read_text())


def add(study, table, name, contours, dem):
    said, off = {}, {}
    for flat in ("keep", "fill"):
        said[flat] = tin(study, contours, flat)
        study.run("talus-trn", f"{flat}.ply", "-o", f"{flat}.tif", "--like", dem, "--reference", dem, "--report",
                  f"{flat}.trn.json", "--overwrite", "--no-db", "-q")
        off[flat] = json.loads((study.out / f"{flat}.trn.json").read_text())["reference"]
    plain, mended = off["keep"]["rmse_m"], off["fill"]["rmse_m"]
    flats = said["fill"]["flat"]
    study.row(table, name, {
        "points": said["keep"]["contours"]["n_points"], "flat area before [%]": f"{100 * flats['share_before']:.1f}",
        "after [%]": f"{100 * flats['share_after']:.1f}", "covered [%]": f"{100 * off['fill']['covered_share']:.1f}",
        "RMSE plain [m]": f"{plain:.3f}", "RMSE mended [m]": f"{mended:.3f}", "change [%]": f"{100 * (mended / plain - 1):+.1f}",
        "largest mended [m]": f"{off['fill']['largest_m']:.2f}"})


@STUDY.part("sites", 2)
def sites(study):
    for name, (contours, dem) in SITES.items():
        study.need_data(f"contours/{contours}.gpkg", f"dem/{dem}")
        add(study, "sites", name, study.data / f"contours/{contours}.gpkg", study.data / f"dem/{dem}")


@STUDY.part("further", 10)
def further(study):
    for name, (dem, interval) in FURTHER.items():
        study.need_data(f"dem/{dem}")
        (study.out / "c.gpkg").unlink(missing_ok=True)
        study.run("gdal_contour", "-q", "-3d", "-a", "ELEV", "-i", interval, study.data / f"dem/{dem}", "c.gpkg",
                  env={**os.environ, "GDAL_PAM_ENABLED": "NO"})
        add(study, "further", name, "c.gpkg", study.data / f"dem/{dem}")


@STUDY.part("genuine", 1)
def genuine(study):
    flats = tin(study, study.data / "contours/su42_os_terrain50_contours.gpkg", "fill")["flat"]
    study.row("genuine", "su42 10 m", {"flat area before [%]": f"{100 * flats['share_before']:.1f}",
                                       "after [%]": f"{100 * flats['share_after']:.1f}"})


if __name__ == "__main__":
    STUDY.main()
