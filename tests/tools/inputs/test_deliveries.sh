# Everyday deliveries become the ground that they were made from.
. "$source_dir/tests/tools/inputs/python.sh"
"$python" "$source_dir/tests/studies/deliveries.py" --bin "${bin%%:*}" --out deliveries >out 2>err || fail "$(cat err)"
