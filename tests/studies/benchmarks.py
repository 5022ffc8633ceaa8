#!/usr/bin/env python3
"""Queries of the terrain, small and large: the benchmark of the release build, medians of five CPU times."""
import json

from study import Study, skip

STUDY = Study(__file__, __doc__)


@STUDY.part("terrain", 60)
def terrain(study):
    program = study.bin.parent / "tests/bench/bench_terrain"
    if not program.exists():
        skip(f"no {program}: cmake --build --preset release")
    said = json.loads(study.run(program, "--benchmark_filter=plane_at|elevation_at|candidate|cells_of",
                                "--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true",
                                "--benchmark_format=json"))
    for one in said["benchmarks"]:
        if one["aggregate_name"] == "median":
            study.row("terrain", one["run_name"].replace("/", ", "), {"CPU time": f"{one['cpu_time']:.3g} {one['time_unit']}"})


if __name__ == "__main__":
    STUDY.main()
