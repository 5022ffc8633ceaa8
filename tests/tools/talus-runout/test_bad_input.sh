# Relations that cannot be read, mixed runs and unfinished ones.
run-probe . 1
mkdir half
run-probe half 1 status=running seed=3
expect 1 talus-runout half/run_0.h5 --trn slope.tif -o r.gpkg
says 'the run is running at 5 of 8 s'
nothing_left r.gpkg
printf 'id,kind\nx,wrong\n' >bad.csv
expect 1 talus-runout run_0.h5 --trn slope.tif -o r.gpkg --mobility bad.csv
says 'bad.csv'
for value in "--path-tolerance-m -1" "--path-tolerance-m nan" "--friction-deg 95" "--friction-deg -5"; do
  expect 2 talus-runout run_0.h5 --trn slope.tif -o r.gpkg $value
  says 'out of range'
done
nothing_left r.gpkg
