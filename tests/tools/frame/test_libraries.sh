# Each executable is linked with the libraries that it uses and with no other (beside C and C++).
command -v readelf >/dev/null || skip "readelf is not installed"

# needs TOOL LIBRARY...: exactly these, sorted
needs() {
  tool=$1
  shift
  found=$(readelf -d "$(command -v "$tool")" | sed -n 's/.*NEEDED.*\[lib\(.*\)\.so.*/\1/p' |
    grep -vxE 'stdc\+\+|m|gcc_s|c|asan|ubsan|ld-.*' | sort | tr '\n' ' ')
  # sanitizers keep references that the optimiser drops: to CGAL's other number types
  if readelf -Ws "$(command -v "$tool")" | grep -q __asan_init; then
    found=$(printf '%s' "$found" | sed 's/\bgmpxx //; s/\bmpfr //')
  fi
  [ "$found" = "$(printf '%s ' "$@")" ] || fail "$tool is linked with $found, expected $*"
}

needs talus-runs crypto sqlite3
needs talus-site crypto gdal hdf5_serial hdf5_serial_hl proj sqlite3 tomlplusplus
needs talus-trn crypto gdal hdf5_serial hdf5_serial_hl proj sqlite3 tomlplusplus
needs talus-tin crypto gdal gmp hdf5_serial hdf5_serial_hl proj sqlite3
needs talus-maps cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3
needs talus-reduce crypto gdal hdf5_serial hdf5_serial_hl proj sqlite3
needs talus-export crypto gdal hdf5_serial hdf5_serial_hl proj sqlite3
needs talus-runout cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-fence cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-hazard cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-trace cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-profile cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3
needs talus-fence-search cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-report cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-dda crypto gdal hdf5_serial hdf5_serial_hl proj sqlite3 tomlplusplus
needs talus-stability cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-verify cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-blocks cairo crypto gdal glib-2.0 gmp gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-check cairo crypto gdal glib-2.0 gobject-2.0 hdf5_serial hdf5_serial_hl pango-1.0 pangocairo-1.0 proj sqlite3 tomlplusplus
needs talus-source crypto gdal gmp hdf5_serial hdf5_serial_hl proj sqlite3 tomlplusplus
exit 0
