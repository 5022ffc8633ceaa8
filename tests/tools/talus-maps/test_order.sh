# Runs in any order, and any interval of frames, give the same bytes.
run-probe . 4 blocks=2
expect 0 talus-maps run_0.h5 run_1.h5 run_2.h5 run_3.h5 --trn slope.tif -o a --min-passages 2 --pages png,pdf,a3
expect 0 talus-maps run_3.h5 run_1.h5 run_0.h5 run_2.h5 --trn slope.tif -o b --min-passages 2 --pages png,pdf,a3
for file in a/*.tif a/*.qml a/*.png a/*.pdf; do
  cmp "$file" "b/${file#a/}" || fail "$file depends on the order of the runs"
done
mkdir fine
run-probe fine 4 blocks=2 frames=0.003
expect 0 talus-maps fine/run_*.h5 --trn fine/slope.tif -o c --min-passages 2
for name in reach velocity ke_total pass_height_top exceedance deposit arrival energy_line; do
  gdal_translate -q -of AAIGrid -b 1 "a/$name.tif" a.asc
  gdal_translate -q -of AAIGrid -b 1 "c/$name.tif" c.asc
  cmp a.asc c.asc || fail "$name depends on the interval of frames"
done

# Pages say no time, are of the paper asked for, and hold words, not pictures of words.
grep -q 'CreationDate' a/reach.pdf && fail 'a page says when it was made'
# (Cairo from 1.18 on compresses the objects of a PDF)
grep -qa -e '/MediaBox \[ 0 0 1190.551181 841.889764 \]' -e /ObjStm a/reach.pdf || fail 'the page is not A3'
gdalinfo a/reach.png | grep -q 'Size is 2480, 1754' || fail 'the picture is not A3 at 150 dots an inch'
expect 2 talus-maps run_0.h5 --trn slope.tif -o d --pages png,a5
says 'png,a5 is not a list of pages, expected png, pdf or png,pdf'
