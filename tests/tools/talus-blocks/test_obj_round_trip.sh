# Blocks exported as OBJ and read again are the same bodies: as many, each with its parts, volume
# and number, also where a block was divided into convex parts.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
expect 0 blocks --report r.json --footprints f.gpkg --set source.max_convex_loss=0.005
expect 0 talus-export blocks.h5 -o blocks.obj --no-db
n=$(value r.json n_blocks)
holds "$(value r.json n_divided) > 0 && $(value r.json n_kept_exact) > 0"
divided=$(grep -c '^g block_[0-9]*_part_1$' blocks.obj)
[ "$divided" -eq "$(value r.json n_divided)" ] || fail "$divided objects with parts, not one a divided block"

printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[material.rock]' '[blocks.back]' 'file = "blocks.obj"' >site.toml
expect 0 talus-blocks site.toml --trn trn.tif -o back.h5 --no-db --report back.json --footprints back.gpkg
[ "$(value back.json n_blocks)" -eq "$n" ] || fail "$(value back.json n_blocks) blocks came back, expected $n"
holds "($(value back.json volume_m3) / $(value r.json volume_m3) - 1) ^ 2 < 1e-18"

# block by block; parts of blocks that were kept exact are found anew
for name in f back; do
  ogrinfo -q -al -geom=NO "$name.gpkg" blocks |
    awk '$1 == "block_id" { b = $NF } $1 == "n_parts" { p = $NF } $1 == "volume_m3" { v = $NF }
      /^OGRFeature/ && seen++ { print b, p, v } END { print b, p, v }' | sort -n >"$name.txt"
done
[ "$n" -eq "$(wc -l <back.txt)" ] || fail "not one footprint a block"
paste -d ' ' f.txt back.txt | awk '
  $1 != $4 || ($3 / $6 - 1) ^ 2 > 1e-14 { print "block differs: " $0; bad = 1 }
  $2 != $5 { ++n_other }
  END { print n_other + 0 >"other.txt"; exit bad }' || fail "blocks came back changed"
holds "$(cat other.txt) <= $(value r.json n_kept_exact)"

# groups changed by other programs are refused or reported
name=$(sed -n 's/^g \(block_[0-9]*\)_part_1$/\1/p' blocks.obj | head -n 1)
awk -v name="$name" '$1 == "o" { is_it = $2 == name; first = n } $1 == "v" { ++n }
  is_it && $1 == "f" { for (i = 2; i <= NF; ++i) $i -= first } is_it' blocks.obj >one.obj
read_again() {
  printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[blocks.one]' 'file = "changed.obj"' \
    '[material.rock]' >site.toml
  expect "$1" blocks --overwrite --report one.json
}
cp one.obj changed.obj
read_again 0
holds "$(value one.json n_blocks) == 1 && $(value one.json n_convex_parts) > 1"
grep -v '^g ' one.obj >changed.obj
read_again 0
holds "$(value one.json n_blocks) > 1"
says 'changed.obj: 1 object holds several closed bodies, which move apart'
grep -v '^o ' one.obj >changed.obj
read_again 0
says "bodies are named like parts, as ${name}_part_0, and move apart"
sed 's/^g .*_part_0/g base/' one.obj >changed.obj
read_again 1
says "changed.obj:2: faces of object $name are outside of its parts"
awk '/^g / { ++k } $1 == "v" && k == 1 { $4 += 3 } { print }' one.obj >changed.obj
read_again 0
says "$name has parts that do not lie against the others"
