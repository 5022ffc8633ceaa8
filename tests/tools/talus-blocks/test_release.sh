# Arrays of release points: along a line, and over the source by its sloping area.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
cat >line.csv <<'CSV'
id,wkt
1,"LINESTRING (500010 5200030, 500030 5200030)"
CSV
ogr2ogr -q -f GPKG line.gpkg line.csv -oo GEOM_POSSIBLE_NAMES=wkt -a_srs EPSG:32633 -nlt LINESTRING
printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[rockfall.edge]' 'shape = "eota"' 'volume_m3 = 0.1' \
  'release_file = "line.gpkg"' 'release_spacing_m = 5' 'rocks = 2' >site.toml
expect 0 blocks --report r.json
[ "$(value r.json n_blocks)" -eq 10 ] || fail "not two bodies at each of five points"
printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[rockfall.wall]' \
  'polygon = [[500010, 5200010], [500030, 5200010], [500030, 5200030], [500010, 5200030]]' \
  'shape = "rock"' 'size_m = [1, 0.8, 0.6]' 'release_spacing_m = 2' >site.toml
expect 0 blocks --report r.json --overwrite
# 400 m2 in plan at about 40 degrees are 522 m2: one body for every 4 m2
holds "$(value r.json n_blocks) > 125 && $(value r.json n_blocks) < 136"

# more bodies than max_blocks are refused before they are made, the limit can be set without a polygon
expect 1 blocks --overwrite --set rockfall.wall.release_spacing_m=1e-7
says 'would release about'
printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[rockfall.edge]' 'shape = "eota"' 'volume_m3 = 0.1' \
  'release_file = "line.gpkg"' 'release_spacing_m = 5' 'rocks = 5' >site.toml
expect 1 blocks --overwrite --set rockfall.edge.release_spacing_m=1e-7
says 'would release about'
expect 1 blocks --overwrite --set source.max_blocks=24
says 'would release about 25 bodies, expected at most 24'
expect 0 blocks --overwrite --set source.max_blocks=25
