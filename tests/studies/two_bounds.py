#!/usr/bin/env python3
"""The two bounds of a slide: gschnitz_gar on a plane that daylights, with constant and with weakening friction.

Three runs each on the elevation model of the whole valley, without its fence, friction scattered by 2 degrees.
Percentiles are those of L95 in the scatter of published events of this volume.
"""
import json

from study import SOURCE, Study

STUDY = Study(__file__, __doc__)
RELATIONS = {"percentile, rockfalls": "corominas_rockfall_all", "percentile, rock avalanches": "mitchell_length"}


def spread(values, digits=0):
    low, high = (f"{bound(values):.{digits}f}" for bound in (min, max))
    return low if low == high else f"{low} to {high}"


@STUDY.part("all", 400)
def compute(study):
    study.need_data("dem/gschnitz_gar_full_5m.tif")
    for case, flags in {"constant": "", "weakening": " --set solver.friction=weakening"}.items():
        study.make(SOURCE / "sample_sites/gschnitz_gar", f"OUT={study.out / case}", "CONTOURS=",
                   f"DEM={study.data / 'dem/gschnitz_gar_full_5m.tif'}", "IMPORT_FLAGS=", "TRN_FLAGS=",
                   "BLOCKS_FLAGS=--set source.failure_surface=daylighting", "RUNS=3", "WITHOUT=no",
                   "DDA_FLAGS=--set fence.valley.active=false --set solver.friction_scatter_deg=2" + flags, "runs",
                   keep_going=True)
        runs = sorted((study.out / f"{case}/runs").glob("run_*.h5"))
        said = json.loads(study.run("talus-runout", *runs, "--trn", f"{case}/bed.tif", "-o", f"{case}.gpkg", "--overwrite",
                                    "--json", "--no-db", "-q", codes=(0, 3)))
        balance = said["balance"]
        percentiles = {title: [run["percentile"] for relation in said["mobility"] if relation["relation"] == name
                               for run in relation["runs"] if run["percentile"] is not None] for title, name in RELATIONS.items()}
        study.row("bounds", f"{case} friction", {
            "L95 [m]": spread([run["mass_95"]["L95_m"] for run in said["runs"]]),
            **{title: spread(values) if values else "-" for title, values in percentiles.items()},
            "left the terrain [%]": f"{100 * balance['left_domain_m3'] / balance['released_m3']:.0f}",
            "still moving [%]": f"{100 * balance['moving_m3'] / balance['released_m3']:.0f}"})


if __name__ == "__main__":
    STUDY.main()
