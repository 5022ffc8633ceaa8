# Helpers of this folder: `python` is one that has GDAL and numpy.

for python in python3 /usr/bin/python3; do
  "$python" -c 'import numpy; from osgeo import gdal' 2>/dev/null && break
done
"$python" -c 'import numpy; from osgeo import gdal' 2>/dev/null || skip "needs python3-gdal and numpy"
command -v gdal_calc.py >/dev/null || skip "needs gdal-bin"
PYTHONPATH=$source_dir/tests/studies
export PYTHONPATH
