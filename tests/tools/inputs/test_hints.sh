# Each hint that holds a command or an option is obeyed; the ground that follows is the true one.
. "$source_dir/tests/tools/inputs/python.sh"
"$python" "$source_dir/tests/tools/inputs/hints.py" "$source_dir" >out 2>&1 || fail "$(grep -A 3 -e FAILED -e Traceback out)"
