# Helpers of this folder: a plane that rises 1 : 2 to the north, 41 x 41 cells of 5 m in EPSG:25832.

command -v gdal_translate >/dev/null || skip "needs gdal-bin"

# plane NAME [X0 Y0 CELL FACTOR]: as an ASCII grid; places and heights times FACTOR
plane() {
  awk -v x0="${2-650000}" -v y0="${3-5200000}" -v d="${4-5}" -v f="${5-1}" 'BEGIN {
    printf "ncols 41\nnrows 41\nxllcorner %.15g\nyllcorner %.15g\ncellsize %.17g\nNODATA_value -9999\n", x0 * f, y0 * f, d * f
    for (r = 0; r < 41; r++) { line = ""; for (c = 0; c < 41; c++) line = line " " (1000 + 2.5 * (40.5 - r)) * f; print line }
  }' >"$1"
}

# off FILE: the largest error of its known nodes against the plane, and their number
off() {
  gdal_translate -q -of XYZ "$1" off.xyz
  awk '$3 > -9999 { e = $3 - 1000 - 0.5 * ($2 - 5200000); e = e < 0 ? -e : e; if (e > worst) worst = e; n++ }
       END { printf "%.6f %d\n", worst, n }' off.xyz
}

# is_plane FILE TOLERANCE [N]: its known nodes, at least N, are on the plane
is_plane() {
  set -- "$1" "$2" "${3-1000}" $(off "$1")
  awk -v e="$4" -v d="$2" -v n="$5" -v least="$3" 'BEGIN { exit !(e <= d && n >= least) }' ||
    fail "$1: off the plane by up to $4 m in $5 nodes, expected at most $2 m in at least $3"
}

# run_hint [PATTERN]: runs the command that the last hint begins with, in quiet
run_hint() { sed -n "s/^ *hint: //p" err | sed 's/, or .*//; s/; .*//' >hint.sh && sh -e hint.sh >/dev/null 2>&1; }
