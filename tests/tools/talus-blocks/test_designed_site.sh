# The paper's case: 39 blocks, none below 50.833 m3, no edge below 1.670 m. The terrain here is the
# grid that the contours were made from; the contours themselves are tested with the pipeline.
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
site=$source_dir/sample_sites/designed
gdal_translate -q -ot Float64 -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 "$site/slope.asc" dem.tif
expect 0 talus-trn dem.tif -o trn.tif --no-db
prints "29 x 41 nodes"
expect 0 talus-blocks "$site/site.toml" --trn trn.tif -o blocks.h5 --no-db --json
value() { sed -n "s/.*\"$1\": \([-0-9.e+]*\),*$/\1/p" out | head -n 1; }
[ "$(value n_blocks)" -eq 39 ] || fail "$(value n_blocks) blocks, expected 39"
awk "BEGIN { exit !($(value smallest_m3) >= 50.833 && $(value shortest_edge_m) >= 1.67) }" ||
  fail "smallest block $(value smallest_m3) m3, shortest edge $(value shortest_edge_m) m"
