# Blocks that overlap at the start, and values no rock has.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
dda() { talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db --set solver.duration_s=0.1 "$@"; }
place() {  # y of the second block
  sed "s/^position_m = .*/position_m = [[500120, 5000030], [500120, $1]]/; s/^spin.*//" site.toml >placed.toml
  sed -i 's/height_above_ground_m = 0.5/height_above_ground_m = 0.01/' placed.toml
  mv placed.toml site.toml
  talus-blocks site.toml --trn slope.tif -o blocks.h5 -q --no-db --overwrite
}

# 2 x 1.5 x 1 m boxes side by side: 0.03 m inside each other
place 5000031.47
expect 1 dda -o run.h5
says '--settle moves blocks apart'
nothing_left run.h5
expect 0 dda -o run.h5 --settle
says 'moved apart, by 0.015 m at most'

# one upon the other by 0.03 m and by 3 mm on the flat: the lower one stays, the upper one rises
for gap in 0.97 0.997; do
  cat >stack.toml <<END
[blocks.a]
shape = "box"
size_m = [1, 1, 1]
position_m = [[500120, 5000030]]
[blocks.b]
shape = "box"
size_m = [1, 1, 1]
position_m = [[500120, 5000030]]
height_above_ground_m = $gap
END
  talus-blocks stack.toml --trn slope.tif -o stack.h5 -q --no-db --overwrite
  expect 0 talus-dda stack.toml --trn slope.tif --blocks stack.h5 -o stack_run.h5 --no-db --set solver.duration_s=0.5 --settle --overwrite
  says "moved apart, by 0.0"
done

# far from rock: a warning with the usual range
expect 0 dda -o light.h5 --settle --set material.rock.density_kg_m3=260
says 'material.rock.density_kg_m3 is 260 kg/m3; rock has 2000 to 3200 kg/m3'
expect 0 dda -o soft.h5 --settle --set material.rock.young_modulus_pa=5e5
says 'material.rock.young_modulus_pa is 5e+05 Pa'
expect 0 dda -o stiff.h5 --settle --set solver.normal_stiffness_n_m=1e15
says 'solver.normal_stiffness_n_m is 1e+15 N/m'

# two blocks of one name
printf 'o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\no a\n' >twice.obj
printf '[material.rock]\n[blocks.a]\nfile = "twice.obj"\nposition_m = [[500120, 5000030]]\n' >twice.toml
expect 1 talus-blocks twice.toml --trn slope.tif -o twice.h5 --no-db
says 'twice.obj:10: object a is defined again here, first in line 1'
