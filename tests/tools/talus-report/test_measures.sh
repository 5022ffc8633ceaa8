# Measures beside the site: what stands there, a risk of zero; and the page of a measure itself.
command -v python3 >/dev/null || skip "needs python3"
mkdir -p s
run-probe s 12 blocks=3 objects=watched seeds=1
exposed='presence = 0.5\nvulnerability = [0.6]\npersons_per_day = 3\n'
sed -i "s/^\(kind\|radius_m\) .*/&\n$exposed/; s/^polygon = .*250062.*/&\n$exposed/" s/site.toml
cat >>s/site.toml <<'TOML'
[hazard]
recipe = "new_zealand_christchurch"
[hazard.class.V1]
frequency_per_a = 0.02
[variant.closed]
cost = 5150
object.house.presence = 0.05
[variant.net]
fence.check.active = true
TOML
evaluated() { # evaluated FOLDER OPTIONS OF THE SITE... -- OF TALUS-TRACE...
  out=$1 site=s/site.toml
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do site="$site $1"; shift; done
  [ $# -eq 0 ] || shift
  mkdir -p $out
  cp s/slope.tif $out/trn.tif
  expect 0 talus-runout $out/runs/run_*.h5 --trn $out/trn.tif -o $out/runout.gpkg --json $out/runout.json --no-db
  expect 0 talus-fence $site $out/runs/run_*.h5 --trn $out/trn.tif -o $out/fence.gpkg --json $out/fence.json --no-db
  expect 0 talus-trace $site $out/runs/run_*.h5 --trn $out/trn.tif -o $out/trace.gpkg --json $out/trace.json --no-db "$@"
}
mkdir -p s/out/runs s/out/variant/closed/runs s/out/variant/net/runs
mkdir net
run-probe net 12 blocks=3 objects=watched seeds=1 standing=1 hits=stopped
cp s/run_*.h5 s/out/runs
cp s/run_*.h5 s/out/variant/closed/runs
cp net/run_*.h5 s/out/variant/net/runs
evaluated s/out
evaluated s/out/variant/closed --variant closed -- --compare s/out/runs/run_*.h5
evaluated s/out/variant/net --variant net -- --compare s/out/runs/run_*.h5
# a dam, as talus-fence describes one
python3 - <<'PY'
import json
name = 's/out/variant/closed/fence.json'
fence = json.load(open(name))
fence['dams'] = [{'name': 'valley', 'kind': 'dam', 'verdict': 'does not meet', 'text': 'does not hold'}]
json.dump(fence, open(name, 'w'))
# and a run that failed
name = 's/out/variant/net/trace.json'
trace = json.load(open(name))
trace['failed_runs'] = [{'run': 'run_3', 'reason': 'energy gained'}]
json.dump(trace, open(name, 'w'))
PY
expect 0 talus-report s/site.toml --dir s/out -o s/out/report.html --no-db
expect 0 talus-report s/site.toml --variant closed --dir s/out/variant/closed -o s/out/variant/closed/report.html --no-db
cat >check.py <<'PY'
import html, math, re
def section(name, title):
    page = open(name).read()
    part = page[page.index(f'<section id="{title}">'):]
    return part[:part.index('</section>')]
def rows(part):
    for row in re.findall(r'<tr>(.*?)</tr>', part, re.S):
        yield [html.unescape(re.sub(r'<[^>]*>', ' ', cell)).strip() for cell in re.findall(r'<td[^>]*>(.*?)</td>', row, re.S)]
site = section('s/out/report.html', 'measures')
table = [row for row in rows(site[:site.index('<h3>')]) if row]
names = [row[0] for row in table]
failed = 'net 1 of 12 runs failed its numerical checks'
assert [' '.join(name.split()) for name in names] == ['the site as it is', 'closed', failed], names
assert table[0][2] == '', ('a fence that is not active', table[0])
assert table[1][2] == 'valley: does not meet', table[1]
assert re.fullmatch('check: .+', table[2][2]), table[2]
shed = [row for row in rows(site[site.index('<h3>shed'):]) if row]
# by hand: none of 12 runs, at most 0.2425 of them (Wilson) x 0.02 x 0.3 a year
bound = 1.959963984540054 ** 2 / (12 + 1.959963984540054 ** 2)
most = 1 / (1 - math.exp(-0.3 * 0.02 * bound))
assert shed[0][-1] == f'0 (at most 1 in {most:.0f})', (shed[0], most)
own = section('s/out/variant/closed/report.html', 'measures')
page = open('s/out/variant/closed/report.html').read()
assert 'Measure: closed, cost 5,150.' in page[:page.index('<nav>')] and 'Measure: closed, cost 5,150.' in own
house = [row for row in rows(own[own.index('<h3>house'):own.index('<h3>hut')]) if row]
# one hit in each run; risks 1 - exp(-0.5 x 0.6 x 0.02) = 0.00598 and 1 - exp(-0.05 x 0.6 x 0.02) = 0.0006
assert house[0][:3] == ['hits a run', '1', '1'] and house[0][3] == '0', house
assert house[3][:3] == ['annual individual risk', '0.00598', '0.0006'], house
assert house[3][3].startswith('-0.00538'), house
assert 'Measure:' not in open('s/out/report.html').read()
PY
python3 check.py || fail 'the pages of measures'
