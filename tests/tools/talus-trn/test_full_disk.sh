# An output that cannot be written whole is refused and leaves nothing behind. A limit on the size
# of files replaces a full disk: the write fails with an error in both cases.
printf 'ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1000\n1 2\n3 4\n' >dem.asc
trap '' XFSZ
(
  ulimit -f 64
  expect 1 talus-trn dem.asc -o full.tif --crs none --cell-size-m 1 --no-db
) || fail "a full disk was not noticed"
says "cannot be written"
nothing_left full.tif

# A folder that takes no new files is not called a full disk.
if [ -w /proc ]; then
  expect 1 talus-trn dem.asc -o /proc/full.tif --crs none --no-db
  says "the folder takes no new files: name another output"
fi
