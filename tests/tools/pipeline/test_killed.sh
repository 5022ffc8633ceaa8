# make that is killed at any moment leaves nothing half-made: the next one goes on to the same bytes.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v setsid >/dev/null || skip "needs setsid"
site whole
made whole
site killed
for pause in 0.05 0.3 0.7 1.2 2; do
  setsid make -C killed BIN= -j2 >log 2>&1 &
  group=$!
  sleep $pause
  kill -9 -$group 2>/dev/null || break
  wait $group 2>/dev/null || true
done
made killed -j2
same whole killed
