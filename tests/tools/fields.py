"""fields.py PAGE FILE...: every field of the layers (.gpkg) and tables (.csv) has a title and is
on the page of fields. With --print as PAGE: prints the rows that should be there."""
import csv
import re
import sqlite3
import sys

UNITS = {'_m_s': 'm/s', '_rad_s': 'rad/s', '_m2': 'm2', '_m3': 'm3', '_kj': 'kJ', '_kg': 'kg',
         '_deg': 'deg', '_cm': 'cm', '_per_a': '1/a', '_m': 'm', '_s': 's', '_a': 'a'}
# names that end in no unit of their own
PLAIN = re.compile(r'share_moved_\d+_m$')


def unit_of(name):
    name = name.removesuffix('_a_run')
    if not PLAIN.match(name):
        for end, unit in UNITS.items():
            if name.endswith(end):
                return unit
    return ''


def sections(path):
    """Text of each layer's section."""
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
        columns = [name for name in columns if name not in ('fid', 'geom')]
        if not columns:
            continue
        out = f'\n## Layer {table}\n{about}\n\n| Field | Title |\n|---|---|\n'
        for name in columns:
            title = titles.get(name) or sys.exit(f'{path}: {table}.{name} has no title')
            unit = unit_of(name)
            if title.endswith(f' [{unit}]') != (unit != ''):
                sys.exit(f'{path}: {table}.{name} is called {title}, its unit is {unit or "none"}')
            out += f'| `{name}` | {title} |\n'
        yield out


if sys.argv[1] == '--print':
    for file in sys.argv[2:]:
        print(''.join(sections(file)), end='')
    sys.exit()
page = open(sys.argv[1], encoding='utf-8').read()
missing = ''
for file in sys.argv[2:]:
    if file.endswith('.csv'):
        names = next(csv.reader(open(file, encoding='utf-8')))
        missing += ''.join(f'{file}: {name}\n' for name in names  # a dot: a key of the site file
                           if '.' not in name and f'| `{name}` |' not in page)
    else:
        missing += ''.join(text for text in sections(file) if text not in page)
if missing:
    sys.exit(f'{sys.argv[1]} does not hold\n{missing}')
