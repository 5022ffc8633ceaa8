# A folder whose server lacks locks is read like any other.
command -v cc >/dev/null || skip "there is no C compiler"
if readelf -Ws "$(command -v talus-dda)" 2>/dev/null | grep -q '__[at]san_init'; then
  skip "sanitizers want to be loaded first"
fi
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
printf '#include <errno.h>\nint flock(int fd, int op) { (void)fd; (void)op; errno = ENOLCK; return -1; }\n' >no_locks.c
cc -shared -fPIC -o no_locks.so no_locks.c
run_dda -o there.h5 -q --set solver.duration_s=0.1
LD_PRELOAD=$work/no_locks.so expect 0 run_dda -o here.h5 -q --set solver.duration_s=0.1
cmp there.h5 here.h5 || fail "another run"
