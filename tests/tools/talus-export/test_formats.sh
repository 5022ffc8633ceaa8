# Exported files are read by the rules of its format and by VTK, and compared with the run.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
expect 0 run_dda -o run.h5 -q

# Python of Debian, with its packages: a machine without them has not installed what tests need
python=/usr/bin/python3
$python -c 'import h5py, vtk, osgeo' || fail "python3-gdal, python3-h5py or python3-vtk9 is missing: sh pipelines/install_packages.sh test"

export_all() {  # NAME OPTIONS...
  name=$1
  shift
  for ending in glb ply obj vtp; do
    expect 0 talus-export run.h5 --trn slope.tif -o "$name.$ending" --no-db "$@"
    prints "3 blocks at "
  done
  expect 0 talus-export run.h5 -o "$name.xmf" --no-db
  prints "3 blocks, 81 frames in $name.xmf"
}
export_all end
$python "$source_dir/tests/tools/talus-export/read_back.py" run.h5 slope.tif 8 end || fail "the end of the run"
export_all moving --time-s 1.52
$python "$source_dir/tests/tools/talus-export/read_back.py" run.h5 slope.tif 1.52 moving || fail "a moment of the run"

# the same bytes again
for ending in glb ply obj vtp; do
  expect 0 talus-export run.h5 --trn slope.tif -o "again.$ending" --no-db
  cmp "end.$ending" "again.$ending" || fail "two exports of one run differ: $ending"
done

# blocks at rest are where the run began
expect 0 talus-export blocks.h5 --trn slope.tif -o rest.vtp --no-db
expect 0 talus-export run.h5 --trn slope.tif --time-s 0 -o start.vtp --no-db
$python - <<'PY' || fail "blocks at rest are elsewhere than at the start of the run"
import numpy, vtk
from vtk.util.numpy_support import vtk_to_numpy
def points(file):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    found = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
    return found[numpy.lexsort(found.round(3).T)]
numpy.testing.assert_allclose(points("rest.vtp"), points("start.vtp"), rtol=0, atol=1e-6)
PY

# blocks that were exported are blocks again
expect 0 talus-export run.h5 -o deposit.obj --no-db
awk '/^shape/ { print "file = \"deposit.obj\""; next } !/^(size_m|position_m|height_above|spin)/' site.toml >again.toml
expect 0 talus-blocks again.toml --trn slope.tif -o again.h5 --no-db --report again.json
grep -q '"n_blocks": 3' again.json || fail "the exported blocks are not three"

# a finished run without frames: its first and last
expect 0 run_dda -o ends.h5 -q --set output.frames=false
expect 0 talus-export ends.h5 -o ends.obj --no-db
cmp ends.obj deposit.obj >/dev/null || [ "$(grep -c '^o ' ends.obj)" -eq 3 ] || fail "a run without frames has no end"
expect 1 talus-export ends.h5 -o early.obj --time-s 3 --no-db
says "has no frames between its first and its last"

# refused
expect 2 talus-export run.h5 -o run.stl --no-db
says "expected a name in .ply, .obj, .glb, .vtp or .xmf"
expect 2 talus-export run.h5 -o late.xmf --time-s 1 --no-db
says "all frames of the blocks alone"
expect 1 talus-export run.h5 -o late.vtp --time-s 9 --no-db
says "expected 0 to 8 s"
sed 's/^1000.0/1001.0/; s/ 1000.0/ 1001.0/g' plane.asc >other.asc
talus-trn other.asc -o other.tif --crs EPSG:32632 -q --no-db
expect 1 talus-export run.h5 --trn other.tif -o other.glb --no-db
says "was computed on another terrain"
expect 1 talus-export blocks.h5 --trn other.tif -o blocks.glb --no-db
says "is not the terrain that blocks.h5 was made for"
expect 2 talus-export blocks.h5 -o blocks.glb --time-s 1 --no-db
says "holds blocks at rest"
expect 1 talus-export slope.tif -o blocks.glb --no-db
expect 1 talus-export run.h5 -o end.xmf --no-db
says "exists already"
rm end.xmf
expect 1 talus-export run.h5 -o end.xmf --no-db
says "end.xdmf.h5: exists already"
nothing_left early.obj late.vtp other.glb blocks.glb
exit 0
