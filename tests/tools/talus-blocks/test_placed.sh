# Meshes and shapes: refused when they are not bodies, otherwise set on the ground.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
placed() { printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[blocks.one]' "$@" >site.toml; }
cube='v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1'
sides='f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8'
printf '%s\n' "$cube" 'f 1 4 3 2' 'f 5 6 7 8' "$sides" >cube.obj
printf '%s\n' "$cube" 'f 1 4 3 2' "$sides" >open.obj
printf '%s\n' "$cube" 'f 2 3 4 1' 'f 8 7 6 5' 'f 5 6 2 1' 'f 6 7 3 2' 'f 7 8 4 3' 'f 8 5 1 4' >inside_out.obj
printf '%s\n' 'v 0 0 0' 'v 4 0 0' 'v 0 4 0' 'v 1 1 0' 'f 1 3 2' 'f 1 2 4' 'f 2 3 4' 'f 3 1 4' >flat.obj
printf '%s\n' 'v 0 0 0' 'v 4 0 0' 'v 0 4 0' 'v 0 0 4' 'v 1 1 -1' 'v 1 1 9' 'v 2 1 9' 'v 1 2 9' \
  'f 1 3 2' 'f 1 2 4' 'f 2 3 4' 'f 3 1 4' 'f 5 8 7' 'f 5 7 6' 'f 7 8 6' 'f 8 5 6' >two.obj
for name in open flat; do
  placed "file = \"$name.obj\"" 'position_m = [500020, 5200020]'
  expect 1 blocks
  says "$name.obj: body 1: the mesh is $name"
done
placed 'file = "inside_out.obj"' 'position_m = [500020, 5200020]'
expect 0 blocks --overwrite
says "was inside-out and has been turned"
placed 'file = "two.obj"' 'position_m = [500020, 5200020]'
expect 0 blocks --overwrite --report r.json
[ "$(value r.json n_blocks)" -eq 2 ] || fail "two bodies in a file are not two blocks"

placed 'file = "cube.obj"' 'scale = 2' 'roll_deg = 90' 'position_m = [[500020, 5200020], [500030, 5200020]]' \
  'height_above_ground_m = 3' 'velocity_m_s = [1, 0, 0]'
expect 0 blocks --overwrite --report r.json
holds "$(value r.json volume_m3) == 16"
for shape in box prism eota eota111 eota211 eota221 rock; do
  placed "shape = \"$shape\"" 'volume_m3 = 2.5' 'position_m = [500020, 5200020]' 'random_orientation = true'
  expect 0 blocks --overwrite --report r.json
  holds "($(value r.json volume_m3) - 2.5) ^ 2 < 1e-20"
done

placed 'shape = "box"' 'size_m = [1]' 'position_m = [500020, 5200020]' 'n_per_point = 3'
expect 1 blocks --overwrite
says 'rocks in [rockfall.NAME]'

placed 'shape = "box"' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says "neither size_m nor volume_m3 is given"
placed 'shape = "box"' 'size_m = [1, 0, 1]' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says "site.toml:5: size_m is 0, expected above 0"
placed 'shape = "sphere"' 'size_m = [1]' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says 'shape is "sphere", expected one of box|prism|eota|eota111|eota211|eota221|rock'
placed 'shape = "box"' 'size_m = [1]' 'position_m = [600020, 5200020]'
expect 1 blocks --overwrite
says "a body at (600020, 5200020) does not lie over known ground"
placed 'shape = "box"' 'size_m = [1]'
expect 1 blocks --overwrite
says "the bodies have no place"
placed 'file = "cube.obj"'
expect 1 blocks --overwrite
says "the mesh does not lie over known ground"
says "give map coordinates in the mesh, or position_m"
placed 'file = "cube.obj"' 'in_place = true'
expect 1 blocks --overwrite
says "the key in_place of [blocks.one] is gone"
placed 'file = "cube.obj"' 'shape = "box"' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says "both file and shape are given"
placed 'file = "missing.obj"' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says "there is no such file"
printf '%s\n' 'hello' >cube.stl
placed 'file = "cube.stl"' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says "is neither a text STL (solid ...) nor a binary one"
printf '%s\n' '[site]' >site.toml
expect 1 blocks --overwrite
says "there is no [source], [blocks.*] or [rockfall.*]"

# a hollow body is refused, bodies that are inside one another and below the ground are said to
inner='v 0.25 0.25 0.25
v 0.75 0.25 0.25
v 0.75 0.75 0.25
v 0.25 0.75 0.25
v 0.25 0.25 0.75
v 0.75 0.25 0.75
v 0.75 0.75 0.75
v 0.25 0.75 0.75'
printf '%s\n' 'o shell' "$cube" 'f 1 4 3 2' 'f 5 6 7 8' "$sides" 'o hole' "$inner" \
  'f 10 11 12 9' 'f 16 15 14 13' 'f 13 14 10 9' 'f 14 15 11 10' 'f 15 16 12 11' 'f 16 13 9 12' >hollow.obj
placed 'file = "hollow.obj"' 'position_m = [500020, 5200020]'
expect 1 blocks --overwrite
says 'hole: is inside-out and stands in shell: a cavity'
printf '%s\n' 'o one' "$cube" 'f 1 4 3 2' 'f 5 6 7 8' "$sides" 'o two' "$inner" \
  'f 9 12 11 10' 'f 13 14 15 16' 'f 9 10 14 13' 'f 10 11 15 14' 'f 11 12 16 15' 'f 12 9 13 16' >nested.obj
placed 'file = "nested.obj"' 'position_m = [500020, 5200020]'
expect 0 blocks --overwrite
says '1 pairs of bodies overlap, most of all one and two: 100 % of the smaller one'
awk '$1 == "v" { printf "v %.2f %.2f %.2f\n", $2 + 500020, $3 + 5200020, $4 + 20; next } { print }' cube.obj >deep.obj
placed 'file = "deep.obj"'
expect 0 blocks --overwrite
says '1 bodies lie wholly below the ground'
