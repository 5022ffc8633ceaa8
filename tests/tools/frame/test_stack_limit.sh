# A stack that is too small is refused in words, before any work; the remedy is tried.
designed=$source_dir/sample_sites/designed
for kilobytes in 64 256 1023; do
  (ulimit -S -s $kilobytes && expect 1 talus-blocks "$designed/site.toml" --trn no.tif -o out.h5 --no-db) || exit 1
  says "stack of this process: limited to $kilobytes kB, expected at least 1024 kB"
  says "hint: ulimit -s 8192"
  nothing_left out.h5
done
expect 0 sh -c "ulimit -S -s 64; ulimit -S -s 8192; talus-site '$designed/site.toml' -o stages --overwrite --no-db"
expect 0 sh -c "ulimit -S -s 1024; talus-site '$designed/site.toml' -o stages --overwrite --no-db"
exit 0
