# Kinds of input that came in wrong once, in a second form: right, refused or warned of.
. "$source_dir/tests/tools/inputs/python.sh"
"$python" "$source_dir/tests/tools/inputs/kinds.py" >out 2>&1 || fail "$(grep -A 3 -e FAILED -e Traceback out)"
