# A tool opens the files that it uses and nothing else: --version no file at all, a run its inputs
# and outputs and files that the libraries need for them.
command -v cc >/dev/null || skip "there is no C compiler"
if readelf -Ws "$(command -v talus-dda)" 2>/dev/null | grep -q '__[at]san_init'; then
  skip "sanitizers want to be loaded first"
fi
cc -shared -fPIC -O1 -o log_reads.so "$source_dir/tests/tools/log_reads.c" -ldl

# opens COMMAND...: the files that it opened, without those that the C library and HDF5 ask of the
# machine and the empty file that PROJ reads in place of proj.ini
opens() {
  : >log
  LD_PRELOAD=$work/log_reads.so LOG_READS=$work/log expect 0 "$@"
  grep -vE '^(/proc/|/sys/|/dev/urandom$|/dev/null$|\.$)' log | sed "s|^$work/||; s|^\./||" | sort -u >opened || true
}

for tool in site source tin trn blocks dda maps runout fence report verify runs; do
  opens "talus-$tool" --version
  [ ! -s opened ] || fail "talus-$tool --version opened $(tr '\n' ' ' <opened)"
done

. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
: >beside.csv # named by nothing

# reads "NAME..." OUTPUTS COMMAND...: that it opened these, its outputs (a pattern), the registry,
# PROJ's database, the tilings that GDAL knows when it makes a GeoPackage, and nothing else
reads() {
  names=$1
  outputs=$2
  shift 2
  opens "$@"
  for name in $names; do
    grep -qx "$name" opened || fail "$1: the log does not know that $name was read"
  done
  inputs=$(echo "$names" | tr ' ' '|')
  grep -vE "^($inputs|$outputs|runs\.sqlite(-wal|-shm|-journal)?|/.*/proj\.(db|ini)|/.*/gdal/tms_.*\.json)$" opened |
    grep -vxF "$work" >others || true
  [ ! -s others ] || fail "$1 opened $(tr '\n' ' ' <others)"
}

reads plane.asc '\.?slope\.(tif|part.*)' talus-trn plane.asc -o slope.tif --crs EPSG:32632 -q --overwrite
reads "site.toml slope.tif" '\.?blocks\.(h5|part.*)' talus-blocks site.toml --trn slope.tif -o blocks.h5 -q
reads "site.toml slope.tif blocks.h5" '\.?run\.(h5|part.*)' \
  talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o run.h5 -q --set solver.duration_s=1
reads "slope.tif run.h5" '\.?runout\.(gpkg|part.*)' talus-runout run.h5 --trn slope.tif -o runout.gpkg -q
reads "slope.tif run.h5" 'maps(/.*)?' talus-maps run.h5 --trn slope.tif -o maps -q
reads "site.toml slope.tif run.h5" '\.?fence\.(gpkg|part.*)' talus-fence site.toml run.h5 --trn slope.tif -o fence.gpkg -q
reads "" 'verify(/.*)?' talus-verify parabola -o verify -q
exit 0
