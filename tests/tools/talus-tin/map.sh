# Helpers of this folder: a small contour map, written as GeoJSON.

# cone [EPSG] [SCALE] [X0 Y0]: four rings around X0 Y0, 100 to 130 m, radius 100 to 40 (times SCALE)
cone() {
  awk -v epsg="${1-32632}" -v scale="${2-1}" -v x0="${3-500000}" -v y0="${4-5200000}" 'BEGIN {
    printf "{\"type\":\"FeatureCollection\","
    if (epsg != "") printf "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:%s\"}},", epsg
    printf "\"features\":[\n"
    for (ring = 0; ring < 4; ++ring) {
      z = 100 + 10 * ring
      r = (100 - 20 * ring) * scale
      printf "%s{\"type\":\"Feature\",\"properties\":{\"ELEV\":%d,\"NAME\":\"ring %d\"},", ring ? ",\n" : "", z, ring
      printf "\"geometry\":{\"type\":\"LineString\",\"coordinates\":["
      for (i = 0; i <= 24; ++i)
        printf "%s[%.8f,%.8f,%d]", i ? "," : "", x0 + r * cos(i % 24 * 3.14159265 / 12), y0 + r * sin(i % 24 * 3.14159265 / 12), z
      printf "]}}"
    }
    printf "\n]}\n"
  }'
}

# lines ELEVATION:X,Y;X,Y;... : a 2-D map of single lines with field ELEV, EPSG:32632
lines() {
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[\n'
  comma=
  for line in "$@"; do
    printf '%s{"type":"Feature","properties":{"ELEV":%s},"geometry":{"type":"LineString","coordinates":[[%s]]}}\n' \
      "$comma" "${line%%:*}" "$(printf %s "${line#*:}" | sed 's/;/],[/g')"
    comma=,
  done
  printf ']}\n'
}

# value FILE KEY: the first value of a key in a JSON report
value() { sed -n "s/^ *\"$2\": *\"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p" "$1" | head -1; }
# data FILE: a PLY without its header
data() { sed '1,/^end_header$/d' "$1"; }
