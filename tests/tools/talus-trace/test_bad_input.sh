# Implausible objects are refused with their section and a remedy.
run-probe . 2
expect 1 talus-trace site.toml run_0.h5 --trn slope.tif -o t.gpkg
says 'has no section [object.*]'
object() { { cat site.toml; printf '%s\n' '[object.a]' "$@"; } >bad.toml; }
refused() { expect 1 talus-trace bad.toml run_0.h5 --trn slope.tif -o t.gpkg; says "$1"; says 'object.a'; nothing_left t.gpkg; }
object 'kind = "house"'
refused 'has no place'
object 'line = [[250010, 350010], [250020, 350010]]'
refused 'is a line without a width'
object 'position_m = [250010, 350010]'
refused 'is a point without a radius'
object 'position_m = [250010, 350010]' 'radius_m = 2' 'line = [[250010, 350010], [250020, 350010]]'
refused 'has more than one place'
object 'polygon = [[250010, 350010], [250020, 350020], [250020, 350010], [250010, 350020]]'
refused 'object.a'
object 'polygon = [[253010, 350010], [253020, 350010], [253020, 350020]]'
refused 'lies outside of the known terrain'
says 'x east, y north'
object 'polygon = [[250070, 350010], [250095, 350010], [250095, 350012]]'
expect 0 talus-trace bad.toml run_0.h5 --trn slope.tif -o t.gpkg
says 'lie outside of the known terrain'
