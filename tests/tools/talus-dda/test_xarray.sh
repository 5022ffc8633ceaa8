# Run files, parts and block sets open in xarray: named dimensions, unit and name of every variable.
. "$source_dir/tests/tools/talus-dda/common.sh"
/usr/bin/python3 -c 'import xarray, netCDF4' 2>/dev/null || skip "no xarray or netCDF4 for Python"
make_inputs
expect 0 run_dda -o run.h5
expect 0 talus-reduce run.h5 --trn slope.tif -o part.h5 --no-db
/usr/bin/python3 - <<'PY' || fail 'a file does not open as it should'
import netCDF4
import xarray

with xarray.open_dataset('run.h5', group='frames') as frames:
    assert frames.position_m.dims == ('time_s', 'block', 'axis'), frames.position_m.dims
    assert frames.attitude.dims == ('time_s', 'block', 'quaternion')
    assert frames.position_m.units == 'm' and 'centroid' in frames.position_m.long_name
    assert frames.sizes['block'] == 3 and frames.time_s.values[0] == 0 and frames.time_s.values[-1] == 8
    on_map = frames.position_m + frames.origin_m
    assert abs(on_map.sel(time_s=0, block=0).values[:2] - (500020, 5000030)).max() < 1e-6
    assert 'UTM zone 32N' in frames.crs
    assert frames.position_m.sel(time_s=4.04, method='nearest').shape == (3, 3)
with xarray.open_dataset('run.h5', group='passages') as passages:
    table = passages.to_dataframe()
    assert len(table) == passages.sizes['row'] > 10 and table.speed_m_s.max() > 5
with xarray.open_dataset('run.h5') as root:
    assert root.Conventions.startswith('CF-') and 'duration_s' in str(root.config.values[0])
    assert str(root.made_with.values[0]).isprintable() or '\n' in str(root.made_with.values[0])


def check(group, path):
    for name, variable in group.variables.items():
        where = f'{path}: {name}'
        assert variable.long_name, where
        assert variable.dtype == str or variable.units, where
        for dimension in variable.dimensions:
            assert not dimension.startswith('phony'), where
        if not path.startswith('part.h5/runs'):  # several long texts are beyond netCDF 4.9
            variable[:]
    for name, inner in group.groups.items():
        check(inner, f'{path}/{name}')


for path in ('run.h5', 'part.h5', 'blocks.h5'):
    with netCDF4.Dataset(path) as file:
        check(file, path)
PY
