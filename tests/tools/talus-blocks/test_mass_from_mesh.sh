# A jointed rock mass in one OBJ file, an `o` a block, neighbours with faces, edges and vertices at
# equal coordinates: every object is a block, with the volume that it has in the file.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
expect 0 talus-trn "$source_dir/tests/data/terrain_F.asc" -o trn.tif --crs none --no-db --overwrite

# mass FILE N: the file gives N blocks of the volumes with which it was made, 4,000 m3 for 39
mass() {
  printf '%s\n' '[site]' '[blocks.mass]' "file = \"$1\"" '[material.rock]' >site.toml
  expect 0 blocks --overwrite --report r.json
  [ "$(value r.json n_blocks)" -eq "$2" ] || fail "$1: $(value r.json n_blocks) blocks, expected $2"
  holds "($(value r.json volume_m3) - $2 * 4000 / 39) ^ 2 < 1e-10 * $2"
}
mass "$source_dir/tests/data/blocks_39.obj" 39

peers=$source_dir/../shared/peers
[ -d "$peers" ] || { echo "the larger masses need ../shared/peers"; exit 0; }
mass "$peers/blocks_390.obj" 390
mass "$peers/blocks_3900.obj" 3900
