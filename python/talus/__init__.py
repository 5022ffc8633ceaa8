"""Runs of Talus in Python: their records in map coordinates, and new runs of a site.

Needs netCDF4, pandas and xarray, and for new runs the tools of Talus. Page: docs/guide/python.md
"""
from .runs import Ensemble, Run, open_ensemble, open_run
from .tools import Site, run

__all__ = ["Ensemble", "Run", "Site", "open_ensemble", "open_run", "run"]
