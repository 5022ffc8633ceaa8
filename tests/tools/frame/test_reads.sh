# A tool opens what it uses and nothing else: --version no file at all, a run its inputs, its
# outputs, the registry and, for the CRS, PROJ's database.
command -v cc >/dev/null || skip "there is no C compiler"
if readelf -Ws "$(command -v talus-dda)" 2>/dev/null | grep -q '__[at]san_init'; then
  skip "sanitizers want to be loaded first"
fi
cc -shared -fPIC -O1 -o log_reads.so "$source_dir/tests/tools/log_reads.c" -ldl

# opens COMMAND...: what it opened, without what the C library and HDF5 ask of the machine
opens() {
  : >log
  LD_PRELOAD=$work/log_reads.so LOG_READS=$work/log expect 0 "$@"
  grep -vE '^(/proc/|/sys/|/dev/urandom$|\.$)' log | sed "s|^$work/||; s|^\./||" | sort -u >opened || true
}

for tool in site tin trn blocks dda maps runout fence report verify runs; do
  opens "talus-$tool" --version
  [ ! -s opened ] || fail "talus-$tool --version opened $(tr '\n' ' ' <opened)"
done

. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
talus-blocks site.toml --trn slope.tif -o blocks.h5 -q --no-db
: >beside.csv # named by nothing
opens talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o run.h5 -q --set solver.duration_s=1
grep -vE '^(site\.toml|slope\.tif|blocks\.h5|\.?run\.(h5|part.*)|runs\.sqlite(-wal|-shm|-journal)?|/.*/proj\.(db|ini))$' \
  opened | grep -vxF "$work" >others || true
[ ! -s others ] || fail "talus-dda opened $(tr '\n' ' ' <others)"
for name in site.toml slope.tif blocks.h5; do
  grep -qx "$name" opened || fail "the log does not know that $name was read"
done
exit 0
