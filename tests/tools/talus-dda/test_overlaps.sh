# The overlaps that health records are those of the bodies: tests/studies/overlaps.py finds the same
# from frames of every step, for boxes that sink into the ground and into each other and for a body
# of two parts; and it ends with 1 where a record says something else.
. "$source_dir/tests/tools/talus-dda/common.sh"
/usr/bin/python3 -c 'import h5py, numpy; from osgeo import gdal' 2>/dev/null || skip "no h5py, numpy or GDAL for Python"
make_terrain
make_site
# two boxes side by side are one body of two parts; one more falls onto them
cat >parts.py <<'END'
faces = [(1, 5, 7, 3), (2, 4, 8, 6), (1, 2, 6, 5), (3, 7, 8, 4), (1, 3, 4, 2), (5, 6, 8, 7)]
def box(low, high, first):
    corners = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    lines = ["v %.17g %.17g %.17g" % tuple(c) for c in corners]
    return lines + ["f " + " ".join(str(first + v - 1) for v in face) for face in faces]
two = ["o two", "g two_part_0"] + box((-1, -1, 0), (0, 1, 1), 1)
two += ["g two_part_1"] + box((0, -1, 0), (0.5, 1, 0.6), 9)
open("two.obj", "w").write("\n".join(two) + "\n")
END
/usr/bin/python3 parts.py
cat >>site.toml <<'END'
[blocks.b]
file = "two.obj"
position_m = [[500120, 5000050]]
height_above_ground_m = 0.01
[blocks.c]
shape = "box"
size_m = [1, 1.2, 0.8]
position_m = [[500120.1, 5000050.1]]
height_above_ground_m = 1.05
END
make_blocks

overlaps() { /usr/bin/python3 "$source_dir/tests/studies/overlaps.py" "$1" --blocks blocks.h5 --trn slope.tif; }
# law paper on springs so soft that the boxes sink
talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db -q --set solver.law=paper --set solver.time_step_s=0.002 --set solver.duration_s=0.5 \
  --set output.frame_interval_s=0.002 --set solver.normal_stiffness_n_m=2e5 -o soft.h5 2>dda.err || true
expect 0 overlaps soft.h5
prints "in the bed"
prints "in block"
if grep -q DIFFERS out; then fail "health and brute force differ"; fi

# half of a depth is another depth, and a step's largest overlap another one
cp soft.h5 other.h5
cp soft.h5 third.h5
/usr/bin/python3 -c 'import h5py
with h5py.File("other.h5", "r+") as run: run["deep_blocks/depth_m"][...] /= 2
with h5py.File("third.h5", "r+") as run: run["health/largest_penetration_m"][...] *= 0.9'
expect 1 overlaps other.h5
prints "DIFFERS"
expect 1 overlaps third.h5
