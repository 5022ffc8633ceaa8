# The plug-in without QGIS: its queries of tools, the command lines it makes, and that it loads
# anywhere.
expect 0 python3 -B "$source_dir/tests/tools/qgis-plugin/units.py" "$source_dir/qgis/talus"
says "OK"
[ -z "$(find "$source_dir/qgis" -name '__pycache__')" ] || fail "compiled files were left beside the plug-in"
