# --exact keeps all of the volume, to 1e-9 of the prism sum.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
expect 0 blocks --exact --report r.json --set source.min_block_volume_m3=0 --set source.min_block_thickness_m=0 \
  --set source.max_block_aspect=1e9
total=$(value r.json volume_m3) prisms=$(value r.json prism_volume_m3) left_out=$(value r.json slivers_left_out_m3)
holds "(($total + $left_out) / $prisms - 1) ^ 2 < 1e-18"
