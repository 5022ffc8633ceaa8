"""fields.py PAGE FILE...: every layer (.gpkg) with its fields, and every column of a table (.csv), is
on the page of fields, and every field of a layer has the title that stands there. What is missing is
printed as it should stand."""
import csv
import re
import sqlite3
import sys
import textwrap

UNITS = {'_m_s': 'm/s', '_rad_s': 'rad/s', '_m2': 'm2', '_m3': 'm3', '_kj': 'kJ', '_kg': 'kg',
         '_deg': 'deg', '_cm': 'cm', '_per_a': '1/a', '_m': 'm', '_s': 's', '_a': 'a'}
# names that end in no unit of their own
PLAIN = re.compile(r'share_moved_\d+_m$')
# parts of a name: those of the first stand as * among the titles, those of the second do not
STATISTICS = {'p50': 'median', 'p90': '90th percentile', 'p95': '95th percentile', 'max': 'largest'}
BOUNDS = {'lo': 'lower bound', 'low': 'lower bound', 'hi': 'upper bound', 'high': 'upper bound'}


def unit_of(name):
    name = name.removesuffix('_a_run')
    if not PLAIN.match(name):
        for end, unit in UNITS.items():
            if name.endswith(end):
                return unit
    return ''


def plain_title(name):
    """n_hits: Number of hits; cost: Cost"""
    unit = next((end for end in UNITS if name.endswith(end)), '')
    words = re.sub('^n_', 'number_of_', name.removesuffix(unit)).replace('_', ' ')
    return words[:1].upper() + words[1:]


def title_in(titles, name, default=plain_title):
    """Title of the field without its unit."""
    if name in titles:
        return titles[name]
    parts = name.split('_')
    for table, other, without in ((BOUNDS, [], default), (STATISTICS, ['*'], lambda _: '')):
        for at, part in enumerate(parts):
            if part in table:
                if title := title_in(titles, '_'.join(parts[:at] + other + parts[at + 1:]), without):
                    return f'{title}, {table[part]}'
    return default(name)


class Page:
    def __init__(self, text):
        text, self.titles = text.partition('\n## Titles')[::2]
        self.titles = dict(re.findall(r'^- `([\w*]+)`: (.*)$', self.titles, re.M))
        self.sections = {}  # of each layer or table: what it is, and of each field its own title or ''
        for name, body in re.findall(r'^## (?:Layer|Table) (\S+)\n(.*?)(?=^## |\Z)', text, re.M | re.S):
            about, like, rows = re.match('(.*?): (?=`|fields of )(?:fields of ([^, ]+)(?:, then|[.]))?(.*)',
                                         ' '.join(body.split())).groups()
            fields = dict(self.sections[like][1]) if like else {}
            fields.update(re.findall(r'`(\w+)`(?: \(([^)]*)\))?', rows))
            self.sections[name] = about, fields

    def title(self, section, name):
        own = {key: title for key, title in self.sections.get(section, ('', {}))[1].items() if title}
        return title_in(self.titles | own, name)

    def section(self, name, about, titles):
        """As it should stand; titles: of each field, without unit."""
        fields = [f'`{field}`' + ('' if self.title(name, field) == title else f' ({title})')
                  for field, title in titles.items()]
        return (f'\n## Layer {name}\n' +
                textwrap.fill(f'{about}: ' + ', '.join(fields) + '.', 100, break_long_words=False,
                              break_on_hyphens=False) + '\n')


def layers(path):
    """Of each layer: name, what it is, titles of its fields without units."""
    base = sqlite3.connect(path)
    tables = [row[0] for row in base.execute(
        "SELECT table_name FROM gpkg_contents WHERE data_type = 'features' ORDER BY rowid")]
    for table in tables:
        titles = dict(base.execute(
            'SELECT column_name, title FROM gpkg_data_columns WHERE table_name = ?', (table,)))
        about = base.execute(
            'SELECT description FROM gpkg_contents WHERE table_name = ?', (table,)).fetchone()[0]
        about = re.sub(r' \(.*|, simplified to .*', '', about)
        columns = [row[1] for row in base.execute(f'PRAGMA table_info("{table}")')]
        plain = {}
        for name in columns:
            if name in ('fid', 'geom'):
                continue
            title = titles.get(name) or sys.exit(f'{path}: {table}.{name} has no title')
            unit = unit_of(name)
            if title.endswith(f' [{unit}]') != (unit != ''):
                sys.exit(f'{path}: {table}.{name} is called {title}, its unit is {unit or "none"}')
            plain[name] = title.removesuffix(f' [{unit}]')
        if plain:
            yield table, about, plain


def main(page, files):
    missing = ''
    for file in files:
        if file.endswith('.csv'):
            names = next(csv.reader(open(file, encoding='utf-8')))
            known = {name for _, fields in page.sections.values() for name in fields}
            missing += ''.join(f'{file}: {name}\n' for name in names  # a dot: a key of the site file
                               if '.' not in name and name not in known)
            continue
        for name, about, titles in layers(file):
            found, fields = page.sections.get(name, ('', {}))
            if (found, list(fields)) != (about, list(titles)) or any(
                    page.title(name, field) != title for field, title in titles.items()):
                missing += page.section(name, about, titles)
    if missing:
        sys.exit(f'{sys.argv[1]} does not hold\n{missing}')


if __name__ == '__main__':
    main(Page(open(sys.argv[1], encoding='utf-8').read()), sys.argv[2:])
