# A file of a stranger makes a tool read no other file than those it names openly: no raw bytes,
# however the request is spelled or nested, no virtual tables, no values kept elsewhere.
command -v python3 >/dev/null || skip "needs python3"
python3 - "$PWD" <<'END'
import sqlite3, struct, sys, zipfile
here = sys.argv[1]
secret = here + "/secret.bin"
open(secret, "wb").write(struct.pack("<64f", *[7] * 64))
frame = ('<VRTDataset rasterXSize="8" rasterYSize="8"><SRS>EPSG:32633</SRS>'
         "<GeoTransform>500000,5,0,5200040,0,-5</GeoTransform>%s</VRTDataset>")
raw = frame % ('<VRTRasterBand dataType="Float32" band="1" subClass="VRTRawRasterBand"><SourceFilename '
               'relativeToVRT="0">' + secret + "</SourceFilename><PixelOffset>4</PixelOffset>"
               "<LineOffset>32</LineOffset><ByteOrder>LSB</ByteOrder></VRTRasterBand>")
source = frame % ('<VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename '
                  'relativeToVRT="0">%s</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>')
def write(name, text): open(name, "w").write(text)
write("raw.vrt", raw)
write("case.vrt", raw.replace("VRTRawRasterBand", "vrtrawrasterband"))
write("entity.vrt", raw.replace("VRTRawRasterBand", "VRTRawRasterB&#x61;nd"))
with zipfile.ZipFile("packed.zip", "w") as packed: packed.write("raw.vrt")
write("in_zip.vrt", source % ("/vsizip/" + here + "/packed.zip/raw.vrt"))
write("lower.vrt", (source % (here + "/raw.vrt")).replace("SourceFilename", "sourcefilename"))
write("inline.vrt", source % raw.replace("&", "&amp;").replace("<", "&lt;"))
write("label.ers", 'DatasetHeader Begin\n DataFile = "' + secret + '"\n DataSetType = ERStorage\n'
      " DataType = Raster\n ByteOrder = LSBFirst\n RasterInfo Begin\n  CellType = IEEE4ByteReal\n"
      "  CellInfo Begin\n   Xdimension = 5\n   Ydimension = 5\n  CellInfo End\n"
      "  NrOfLines = 8\n  NrOfCellsPerLine = 8\n  RegistrationCoord Begin\n   Eastings = 500000\n"
      "   Northings = 5200040\n  RegistrationCoord End\n  NrOfBands = 1\n RasterInfo End\nDatasetHeader End\n")
write("secret.csv", "z,WKT\n700,\"LINESTRING(500000 5200000,500050 5200000)\"\n710,\"LINESTRING(500000 5200050,500050 5200050)\"\n")
for name, sql in (("table", "CREATE VIRTUAL TABLE contours USING VirtualOGR('%s')"),
                  ("named", "CREATE VIRTUAL TABLE \"a using rtree(\" USING VirtualOGR('%s')"),
                  ("spelled", "create /**/ virtual table contours using/**/VirtualOGR('%s')")):
    table = "a using rtree(" if name == "named" else "contours"
    base = sqlite3.connect(name + ".sqlite")
    base.execute("CREATE TABLE a (b)")
    base.execute("PRAGMA writable_schema = 1")
    base.execute("INSERT INTO sqlite_master VALUES ('table', ?, ?, 0, ?)",
                 (table, table, sql % (here + "/secret.csv")))
    base.commit()
    base.close()
END
for file in raw case entity in_zip lower inline; do
  expect 1 talus-trn $file.vrt -o t.tif --no-db
  says "takes the raw bytes of a file" "--allow-network"
done
expect 1 talus-trn label.ers -o t.tif --no-db --crs none
says "ERS" "--allow-network"
for file in table named spelled; do
  expect 1 talus-tin $file.sqlite -o t.ply --no-db --crs EPSG:32633
  says "virtual table " "--allow-network"
done
# they would be read, and are with permission
for file in raw case entity in_zip lower inline; do
  talus-trn $file.vrt -o t.tif --no-db --overwrite --allow-network >out || fail "$file.vrt was no raster"
  grep -q '7 to 7 m' out || fail "$file.vrt: $(cat out)"
done
talus-trn label.ers -o t.tif --no-db --overwrite --allow-network --crs none >out || fail "label.ers was no raster"
expect 1 talus-tin table.sqlite -o t.ply --no-db --crs EPSG:32633 --allow-network
says "the layers are: a, contours"
