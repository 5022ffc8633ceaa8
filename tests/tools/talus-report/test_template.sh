# --qgis-template: an office's layout in place of the shipped one; a template that cannot be filled
# is refused.
run-probe . 2 still_runs=1
mkdir -p results/runs
mv run_*.h5 results/runs/
cp slope.tif results/trn.tif
expect 0 talus-runout results/runs/*.h5 --trn results/trn.tif -o results/runout.gpkg --json results/runout.json --no-db
# report NAME CODE OPTION...: NAME.qgz, and its content
report() {
  name=$1 code=$2
  shift 2
  expect "$code" talus-report site.toml --dir results -o "$name.html" --qgis "$name.qgz" --no-db --overwrite "$@"
  [ "$code" != 0 ] || python3 -m zipfile -e "$name.qgz" .
}
# same_project A B: but for the run ids, which tell options apart
same_project() {
  for name in "$1" "$2"; do sed 's/run id [0-9a-f]*/run id/' "$name.qgs" >"$name.txt"; done
  cmp "$1.txt" "$2.txt" || fail "$1 and $2 differ"
}
shipped=$source_dir/tools/report/project.qgs
report plain 0
cp plain.qgz first.qgz
report plain 0
cmp plain.qgz first.qgz || fail 'equal inputs give other bytes'
report copy 0 --qgis-template "$shipped"
same_project plain copy
python3 -m zipfile -c office.qgz "$shipped"
report packed 0 --qgis-template office.qgz
same_project plain packed

sed 's/labelText="Signature:"/labelText="Office of Rocks, {site}, {run_id}"/; s/size="297,210,mm"/size="420,297,mm"/' "$shipped" >ours.qgs
report office 0 --qgis-template ours.qgs
grep -q 'labelText="Office of Rocks, probe, [0-9a-f]\{16\}"' office.qgs || fail 'words of the office are not there'
grep -q 'size="420,297,mm"' office.qgs || fail 'the size of the page is not that of the office'

# refused EDIT MESSAGE: the shipped template, edited by sed
refused() {
  sed "$1" "$shipped" >wrong.qgs
  report wrong 1 --qgis-template wrong.qgs
  says "$2"
  nothing_left wrong.html wrong.qgz
}
refused '/<Layouts>/,/<\/Layouts>/d' 'wrong.qgs: has no print layout, expected one with a map item'
says 'copy report/project.qgs of share/talus'
refused 's/type="65639"/type="65640"/' 'wrong.qgs: layout Map: has no map item, expected one'
line=$(grep -n 'labelText="Signature:"' "$shipped" | cut -d: -f1)
refused 's/labelText="Signature:"/labelText="{tittle}"/' "wrong.qgs:$line: layout Map, item Signature: has {tittle}, expected one of {author}, {crs}, {date}, {remark}, {run_id}, {site}, {statement}, {title}, {version}"
says 'did you mean {title}?'
refused 's/<\/qgis>//' 'wrong.qgs: is not a QGIS project: '
python3 -m zipfile -c empty.qgz out
report wrong 1 --qgis-template empty.qgz
says 'empty.qgz: holds no .qgs that can be read'
expect 2 talus-report site.toml --dir results -o none.html --no-db --qgis-template ours.qgs
says '--qgis'
