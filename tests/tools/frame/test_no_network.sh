# Nothing reaches out: a foreign file asks no other machine, with any names in it.
# --allow-network lets it.
command -v python3 >/dev/null || skip "needs python3"
cat >listener.py <<'END'
import http.server, sys
class Told(http.server.BaseHTTPRequestHandler):
    def answer(self):
        open("asked", "a").write(self.path + "\n")
        self.send_error(404)
    do_GET = do_HEAD = do_POST = answer
    def log_message(self, *words): pass
server = http.server.HTTPServer(("127.0.0.1", 0), Told)
open("port.part", "w").write(str(server.server_port))
import os; os.rename("port.part", "port")
server.serve_forever()
END
python3 listener.py &
listener=$!
trap 'kill $listener' EXIT
n=0
until [ -s port ]; do
  n=$((n + 1))
  [ $n -lt 600 ] || fail "no listener"
  sleep 0.05
done
site=http://127.0.0.1:$(cat port)
frame='<VRTDataset rasterXSize="8" rasterYSize="8"><SRS>EPSG:32633</SRS><GeoTransform>500000,5,0,5200040,0,-5</GeoTransform>'
source_of() { printf '%s<VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="%s">%s</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>\n' "$frame" "$1" "$2"; }
source_of 0 "/vsicurl/$site/dem.tif" >curl.vrt
source_of 0 "/vsigzip//vsicurl/$site/dem.tif.gz" >nested.vrt
source_of 1 curl.vrt >outer.vrt
printf '<GDAL_WMS><Service name="TMS"><ServerUrl>%s/${z}/${x}/${y}</ServerUrl></Service><DataWindow><UpperLeftX>500000</UpperLeftX><UpperLeftY>5200040</UpperLeftY><LowerRightX>500040</LowerRightX><LowerRightY>5200000</LowerRightY><TileLevel>0</TileLevel></DataWindow><Projection>EPSG:32633</Projection><BlockSizeX>8</BlockSizeX><BlockSizeY>8</BlockSizeY><BandsCount>1</BandsCount></GDAL_WMS>\n' "$site" >wms.xml
source_of 0 "WMS:$site/wms?REQUEST=GetMap" >wms.vrt
for file in curl.vrt nested.vrt outer.vrt wms.xml wms.vrt; do
  expect 1 talus-trn $file -o t.tif --no-db
  says hint
done
expect 1 talus-trn "/vsicurl/$site/dem.tif" -o t.tif --no-db
printf '{"type":"FeatureCollection","crs":{"type":"link","properties":{"href":"%s/crs.wkt","type":"ogcwkt"}},"features":[{"type":"Feature","properties":{"z":1},"geometry":{"type":"LineString","coordinates":[[500000,5200000],[500050,5200000]]}},{"type":"Feature","properties":{"z":2},"geometry":{"type":"LineString","coordinates":[[500000,5200050],[500050,5200050]]}}]}\n' "$site" >link.geojson
talus-tin link.geojson -o t.ply --no-db --elevation-field z >out 2>err || true
printf '<OGRVRTDataSource><OGRVRTLayer name="a"><SrcDataSource>/vsicurl/%s/a.geojson</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>\n' "$site" >lines.vrt
expect 1 talus-tin lines.vrt -o t.ply --no-db
[ ! -e asked ] || fail "other machines were asked for $(tr '\n' ' ' <asked)"

expect 1 talus-trn curl.vrt -o t.tif --no-db --allow-network
[ -s asked ] || fail "--allow-network asks nobody"
