# The report is one file that asks for nothing from elsewhere; the project names files that exist.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v python3 >/dev/null || skip "needs python3"
site slope
sed -i 's/^duration_s = .*/duration_s = 2/' slope/site.toml  # blocks move more than a metre
sed -i 's/^name = "designed"/name = "<b>\&\\" name"/' slope/site.toml
made slope -j2
python3 - slope/out <<'END' || fail "see above"
import base64, html.parser, json, os, re, struct, sys, zipfile, zlib
import xml.etree.ElementTree as xml
out = sys.argv[1]
text = open(f"{out}/report.html", encoding="utf-8").read()

class Page(html.parser.HTMLParser):
    void = {"meta", "link", "img", "br", "input", "image", "path"}
    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links, self.errors = [], set(), [], []
    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag not in self.void: self.open.append(tag)
        self.ids.add(values.get("id"))
        self.links += [v for k, v in attributes if k in ("src", "href")]
    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.void: self.open.pop()
    def handle_endtag(self, tag):
        if tag in self.void: return
        if not self.open or self.open.pop() != tag: self.errors.append(tag)

page = Page()
page.feed(text)
assert not page.errors and not page.open, f"tags that do not close: {page.errors} {page.open}"
for section in "result maps animation runout fences curves health assumed plan provenance viewer scene".split():
    assert section in page.ids, f"no {section}"
for link in page.links:
    assert link.startswith(("data:", "#")), f"not in the file: {link[:80]}"
    if link.startswith("#"): assert link[1:] in page.ids, link
assert text.count("arrivals for design") == 1, "the fields do not say what their verdict rests on"
assert "<b>&\"" not in text, "the site's name is markup"
assert "&lt;b&gt;&amp;&quot; name" in text
assert text.count('class="cells"') == 11, "ten maps and the change by the fence"
assert text.count('class="legend"') == 11, "a map without its legend in the page's letters"
assert text.count('data:image/png') == 12, "the ground is not drawn once for all maps"
maps = [json.loads(values) for values in re.findall(r'<script type="application/json">(.*?)</script>', text)]
assert len(maps) == 11, "a map without values"
for one in maps:
    values = zlib.decompress(base64.b64decode(one["values"]))
    assert len(values) == 4 * one["n_rows"] * one["n_cols"], "values that are not those of the cells"
values = zlib.decompress(base64.b64decode(maps[0]["values"]))
fastest = max(v for v in struct.unpack(f"<{len(values) // 4}f", values) if v == v)
assert maps[0]["unit"] == "m/s" and f"<b>{fastest:.3g} m/s</b>" in text, f"{fastest} is not the largest speed"
assert len(text) < 4e6, f"{len(text)} bytes"
assert "path of the centre of mass of all blocks" in text, "nothing says whether the mass went"
assert "<th class=\"n\">value</th>" in text and "<th class=\"n\">p95</th></tr>" not in text, "a spread of one run"
assert "Nothing came to the fence" in text, "energies of no arrivals"
assert text.count("the fence is a rigid wall, which no net is") >= 3, "a number of a wall passes for one of a net"
assert "tan 25&deg; = 0.466" in text, "no friction beside H/L of the centre of mass"
assert "of the released mass moved more than 1 m" in text, "nothing says how much of the mass moved"
assert 'class="banner"' not in text, "a mark without a failure"
assert "Numerical checks: passed" in text and "talus-import site.toml" in text

archive = zipfile.ZipFile(f"{out}/site.qgz")
assert archive.testzip() is None
project = xml.fromstring(archive.read(archive.namelist()[0]))
sources = [e.text for e in project.find("projectlayers").iter("datasource")]
assert len(sources) > 15, sources
for source in sources:
    assert source.startswith("./"), source
    assert os.path.exists(f"{out}/{source.split('|')[0]}"), source
groups = [g.get("name") for g in project.find("layer-tree-group").findall("layer-tree-group")]
assert groups == ["Source", "Protective structures", "Paths", "Hazard", "Terrain"], groups
hazard = next(g for g in project.find("layer-tree-group") if g.get("name") == "Hazard")
layers = hazard.findall("layer-tree-layer")
shown = {os.path.basename(layer.get("source"))[:-4] for layer in layers}
made = {name[:-4] for name in os.listdir(f"{out}/maps") if name.endswith(".tif")}
assert shown == made and len(made) == 10, f"maps {made}, in the project {shown}"
names = {layer.get("name") for layer in layers}
assert "Energy, largest [kJ]" in names and not names & made, f"names of files: {names}"
assert "Contours every" in archive.read(archive.namelist()[0]).decode(), "no contours"
layout = project.find("Layouts/Layout")
assert layout is not None and layout.find(".//ComposerMapGrid") is not None, "a layout without coordinates"
END

rm slope/out/runs/run_1.h5
expect 1 talus-report slope/site.toml --dir slope/out -o report.html --no-db
says "holds 0 of the 1 runs that runout.json is made from"
rm slope/out/runout.json
expect 1 talus-report slope/site.toml --dir slope/out -o report.html --no-db
says "runout.json: there is no such file"
says "hint: run talus-runout first"
nothing_left report.html
