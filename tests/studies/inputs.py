"""Inputs of known truth, and a user who obeys the hints of the tools.

The ground is a plane that rises 1 : 2 to the north: z = z0 + (y - 5200000) / 2 in EPSG:25832, 200 m
by 200 m from x 650000 on; other systems have the like plane in theirs. Needs python3-gdal, numpy.
"""
import os
import re
import shlex
import subprocess

import numpy as np
from osgeo import gdal, ogr, osr

gdal.UseExceptions()
ogr.UseExceptions()
osr.UseExceptions()
X0, Y0, SIDE, CODE = 650000.0, 5200000.0, 200.0, 'EPSG:25832'
SHELL = r'(?:gdalwarp|gdal_translate|gdalbuildvrt|gdal_calc\.py|ogr2ogr|ogrmerge\.py|unzip|mkdir|tar|iconv|sed|pdal)'
FEET, SURVEY_FEET = 0.3048, 1200 / 3937


def srs(code):
    """The system, x east first; '' and None: none."""
    system = osr.SpatialReference()
    if code:
        system.SetFromUserInput(code)
    system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    return system


class Plane:
    """z = z0 + (y - y0) / 2 over 200 m x 200 m from x0, y0 on, in the system `code`."""

    def __init__(self, z0=1000.0, code=CODE, x0=X0, y0=Y0):
        self.z0, self.code, self.x0, self.y0 = z0, code, x0, y0

    def z(self, x, y):
        return self.z0 + (y - self.y0) / 2 + 0 * x

    def contours(self, step=10.0):
        """[(z, [(x, y), ...])]: 11 lines for steps of 10 m, 20 m apart in plan."""
        n = int(SIDE / 2 / step) + 1
        xs = self.x0 + np.linspace(0, SIDE, 11)
        return [(self.z0 + k * step, [(x, self.y0 + 2 * k * step) for x in xs]) for k in range(n)]

    def cells(self, cell=5.0):
        """Heights of cell centres, the northernmost row first."""
        n = round(SIDE / cell)
        x, y = self.x0 + (np.arange(n) + .5) * cell, self.y0 + SIDE - (np.arange(n) + .5) * cell
        return self.z(x[None, :], y[:, None])

    def points(self, n=15, seed=3):
        """Random points of the ground, (n * n, 3), the four corners among them."""
        rng = np.random.default_rng(seed)
        p = rng.uniform(0, SIDE, (n * n, 2))
        p[:4] = [(0, 0), (0, SIDE), (SIDE, 0), (SIDE, SIDE)]
        x, y = self.x0 + p[:, 0], self.y0 + p[:, 1]
        return np.column_stack([x, y, self.z(x, y)])


class Hill(Plane):
    """The plane with a hill, whose slopes tell a shift in plan from one in height."""

    def z(self, x, y):
        r2 = (x - self.x0 - SIDE / 2) ** 2 + (y - self.y0 - SIDE / 2) ** 2
        return self.z0 + (y - self.y0) / 2 + 25 * np.exp(-r2 / 50 ** 2)

    def contours(self, step=5.0):
        n, cell = 401, SIDE / 400
        memory = gdal.GetDriverByName('MEM').Create('', n, n, 1, gdal.GDT_Float64)
        memory.SetGeoTransform((self.x0 - cell / 2, cell, 0, self.y0 + SIDE + cell / 2, 0, -cell))
        x, y = np.meshgrid(self.x0 + np.arange(n) * cell, self.y0 + SIDE - np.arange(n) * cell)
        memory.GetRasterBand(1).WriteArray(self.z(x, y))
        lines = ogr.GetDriverByName('Memory').CreateDataSource('')
        layer = lines.CreateLayer('c', None, ogr.wkbLineString)
        layer.CreateField(ogr.FieldDefn('z', ogr.OFTReal))
        gdal.ContourGenerate(memory.GetRasterBand(1), step, self.z0 % step, [], 0, 0, layer, -1, 0)
        return [(row.GetField('z'), row.GetGeometryRef().SimplifyPreserveTopology(.02).GetPoints()) for row in layer]


# --- writers -------------------------------------------------------------------------------------

def raster(path, cells, corner, cell, code=CODE, driver='GTiff', kind=gdal.GDT_Float32, nodata=None, unit='',
           place=None):
    """One band; `corner`: north-west, `place`: a geotransform instead."""
    memory = gdal.GetDriverByName('MEM').Create('', cells.shape[1], cells.shape[0], 1, kind)
    memory.SetGeoTransform(place or (corner[0], cell, 0, corner[1], 0, -cell))
    if code:
        memory.SetProjection(srs(code).ExportToWkt())
    band = memory.GetRasterBand(1)
    if nodata is not None:
        band.SetNoDataValue(nodata)
    band.SetUnitType(unit)
    band.WriteArray(cells)
    gdal.GetDriverByName(driver).CreateCopy(path, memory)


def dem(path, plane, cell=5.0, **more):
    """The plane as a raster; `factor` of places and heights, `height_factor` of heights alone."""
    factor = more.pop('factor', 1)
    heights = plane.cells(cell) * more.pop('height_factor', factor)
    corner = (plane.x0 * factor, (plane.y0 + SIDE) * factor)
    raster(path, heights, corner, cell * factor, more.pop('code', plane.code), **more)


def shapes(path, rows, code=CODE, driver='GPKG', layer=None, fields=(), options=()):
    """rows: (WKT, {field: value}); fields: (name, OGR type)."""
    if os.path.exists(path):
        data = ogr.Open(path, 1)
    else:
        data = ogr.GetDriverByName(driver).CreateDataSource(path)
    made = data.CreateLayer(layer or os.path.splitext(os.path.basename(path))[0], srs(code) if code else None,
                            ogr.wkbUnknown if driver != 'ESRI Shapefile' else
                            ogr.CreateGeometryFromWkt(rows[0][0]).GetGeometryType(), list(options))
    for name, kind in fields:
        made.CreateField(ogr.FieldDefn(name, kind))
    for wkt, values in rows:
        feature = ogr.Feature(made.GetLayerDefn())
        feature.SetGeometry(ogr.CreateGeometryFromWkt(wkt))
        for name, value in values.items():
            feature.SetField(name, value)
        made.CreateFeature(feature)


def line(points, z=None):
    if z is None:
        return 'LINESTRING (' + ', '.join(f'{x!r} {y!r}' for x, y in np.asarray(points).tolist()) + ')'
    return 'LINESTRING Z (' + ', '.join(f'{x!r} {y!r} {z!r}' for x, y in np.asarray(points).tolist()) + ')'


def contours(path, plane, field='ELEV', kind=ogr.OFTReal, z=False, factor=1.0, height_factor=None, value=None, **more):
    """The plane as contours: heights in a field (None: none) as value(height), or in Z."""
    up = factor if height_factor is None else height_factor
    rows = [(line(np.asarray(points) * factor, height * up if z else None),
             {field: (value or float)(height * up)} if field else {}) for height, points in plane.contours()]
    shapes(path, rows, more.pop('code', plane.code), fields=[(field, kind)] if field else (), **more)


def square(plane, low=60, high=140):
    """A polygon in the middle of the plane, as WKT."""
    x, y = plane.x0, plane.y0
    corners = [(low, low), (high, low), (high, high), (low, high), (low, low)]
    return 'POLYGON ((' + ', '.join(f'{x + a} {y + b}' for a, b in corners) + '))'


def write(path, words):
    with open(path, 'wb' if isinstance(words, bytes) else 'w', **({} if isinstance(words, bytes) else
                                                                   {'encoding': 'utf-8'})) as file:
        file.write(words)


def dxf(path, entities, header=''):
    """Entities as DXF text; `header`: variables, such as $INSUNITS."""
    write(path, '0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n' + header + '0\nENDSEC\n0\nSECTION\n2\nENTITIES\n' +
          entities + '0\nENDSEC\n0\nEOF\n')


def polyline(layer, points, elevation=None):
    words = f'0\nLWPOLYLINE\n100\nAcDbEntity\n8\n{layer}\n100\nAcDbPolyline\n90\n{len(points)}\n70\n0\n'
    if elevation is not None:
        words += f'38\n{elevation}\n'
    return words + ''.join(f'10\n{x}\n20\n{y}\n' for x, y in points)


def mesh(plane, n=10):
    """Vertices (n + 1)^2 x 3 and triangles of the ground."""
    x, y = np.meshgrid(plane.x0 + np.linspace(0, SIDE, n + 1), plane.y0 + np.linspace(0, SIDE, n + 1))
    vertices = np.column_stack([x.ravel(), y.ravel(), plane.z(x, y).ravel()])
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            faces += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    return vertices, faces


def landxml(path, surfaces, unit='<Metric linearUnit="meter"/>', system=''):
    """surfaces: [(name, vertices, faces)]."""
    words = [f'<?xml version="1.0"?>\n<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2">'
             f'<Units>{unit}</Units>{system}<Surfaces>']
    for name, vertices, faces in surfaces:
        words.append(f'<Surface name="{name}"><Definition surfType="TIN"><Pnts>')
        words += [f'<P id="{i + 1}">{y!r} {x!r} {z!r}</P>' for i, (x, y, z) in enumerate(vertices.tolist())]
        words.append('</Pnts><Faces>')
        words += ['<F>' + ' '.join(str(i + 1) for i in face) + '</F>' for face in faces]
        words.append('</Faces></Definition></Surface>')
    write(path, '\n'.join(words) + '</Surfaces></LandXML>\n')


# --- the user ------------------------------------------------------------------------------------

def call(command):
    """(exit code, output, messages), long lines not split: a command line, or its words."""
    done = subprocess.run(command, shell=isinstance(command, str), capture_output=True, check=False)
    printed, said = (text.decode('utf-8', 'replace').replace(';\n  ', '; ') for text in (done.stdout, done.stderr))
    return done.returncode, printed, said


def hint_in(said):
    """The last hint of standard error."""
    return next((row.split('hint: ', 1)[1] for row in reversed(said.splitlines()) if 'hint: ' in row), '')


def commands_in(hint):
    """Commands of the shell. Each ends at a semicolon, at ", or ", or with the hint."""
    found = []
    at = 0
    while begin := re.compile(r'(?<![\w-])' + SHELL + r' ').search(hint, at):
        at, quote = begin.start(), ''
        while at < len(hint):
            if quote:
                quote = '' if hint[at] == quote else quote
            elif hint[at] in '"\'':
                quote = hint[at]
            elif hint.startswith((';', ', or '), at):
                break
            at += 1
        found.append(hint[begin.start():at])
    return found


def made_by(command):
    """The file that a command of the shell writes."""
    words = shlex.split(command.split(' && ')[-1])
    if '>' in words:
        return words[words.index('>') + 1]
    if '--outfile' in words:
        return words[words.index('--outfile') + 1]
    if words[0] in ('ogr2ogr', 'gdalbuildvrt', 'ogrmerge.py'):
        return next(word for word in words if re.search(r'\.(gpkg|vrt|csv)$', word))
    return words[-1]


def terrain_of(tool, source, options, said=None):
    """Calls talus-tin or talus-trn; (accepted, standard error). The terrain is t.tif."""
    out = 't.ply' if tool == 'talus-tin' else 't.tif'
    code, _, err = call([tool, source, '-o', out, '--no-db', '--overwrite', *options])
    if said is not None:
        said.append(err)
    assert code in (0, 1, 2), f'{tool} ended with {code}: {err}'
    if code != 0 or tool == 'talus-trn':
        return code == 0, err
    code, _, tin_err = call(['talus-trn', 't.ply', '-o', 't.tif', '--cell-size-m', '5', '--no-db', '--overwrite', '-q'])
    return code == 0, err if code == 0 else tin_err


def options_in(way, fill):
    """The words of an option of a hint, placeholders of codes and names filled in."""
    for what, instead in fill.items():
        way = way.replace(what, instead)
    return [word.rstrip(',;.') for word in shlex.split(way)]


def with_options(given, more):
    """An option that is given again takes the place of the former."""
    words = list(given)
    for name, *value in (more[i:i + 2] for i in range(0, len(more), 2)):
        if name in words and '=' not in ''.join(value):
            at = words.index(name)
            del words[at:at + 1 + len(value)]
        words += [name, *value]
    return words


def values_of(option, hint):
    """The option in a hint with its value, if it has one there: "--window 1,2,3,4"."""
    at = hint.find(option)
    assert at >= 0, f'no "{option}" in the hint: {hint}'
    if len(option.split()) > 1 or option in ('--points', '--accept-doubts', '--accept-ballpark'):
        return option
    return re.match(r'\S+ ?\S*', hint[at:]).group().rstrip(',;')


def drop(options, name):
    at = options.index(name)
    return options[:at] + options[at + 2:]


def follow(way, hint, source, options, fill, then, said):
    """Next input of the user: (source, options)."""
    if way.startswith(('leave ', 'omit ')):
        assert way in hint, f'no "{way}" in the hint: {hint}'
        return source, drop(options, way.split()[1])
    if way == 'name one':
        return shlex.split(hint.split('name one: ')[1])[0], options
    if way.startswith('--'):
        return source, with_options(options, options_in(values_of(way, hint), fill))
    if '|' in way:
        assert way in hint, f'no "{way}" in the hint: {hint}'
        return way, options
    if way == 'talus-trn' and 'TERRAIN.tif' not in hint:
        command = re.search(r'talus-trn [^;]*', hint)[0]
        for what, instead in fill.items():
            command = command.replace(what, instead)
        code, _, err = call(command + ' --no-db')
        assert code == 0, f'the command of the hint fails: {command}: {err}'
        words = shlex.split(command)
        made = words[words.index('-o') + 1]
        return (source, [made if word == words[1] else word for word in options]) if words[1] in options else (made, [])
    if way == 'talus-trn':  # a call of its own, which makes the source
        made = terrain_of('talus-trn', source, drop(options, '--t-srs'), said)
        assert made[0], f'refused: {made[1]}'
        os.rename('t.tif', 'terrain.tif')
        return 'terrain.tif', shlex.split(re.search(r'TERRAIN.tif (.*)', hint)[1])
    name, _, number = way.partition('#')
    commands = [command for command in commands_in(hint) if command.split()[0] == name]
    assert len(commands) > int(number or 0), f'no {name} in the hint: {hint}'
    command = commands[int(number or 0)]
    for what, instead in fill.items():
        command = command.replace(what, instead)
    code, _, err = call(command)
    assert code == 0, f'the command of the hint fails: {command}: {err}'
    made = made_by(command)
    if source not in shlex.split(command) and any(word in shlex.split(command) for word in options):  # another input
        return source, [made if word in shlex.split(command) else word for word in options]
    left = [word for word in options if word not in shlex.split(command) or word.startswith('EPSG')]
    return made, with_options(left, shlex.split(then))


def nodes_of(plane, path, code):
    """x, y in the system of the ground, z and whether it is known, of the nodes of a terrain; their distance."""
    data = gdal.Open(path)
    g, band = data.GetGeoTransform(), data.GetRasterBand(1)
    z = band.ReadAsArray().astype(float)
    known = np.isfinite(z) & (z != band.GetNoDataValue())
    x, y = np.meshgrid(g[0] + (np.arange(z.shape[1]) + .5) * g[1], g[3] + (np.arange(z.shape[0]) + .5) * g[5])
    if code:
        own = srs(data.GetProjection())
        if own.IsCompound():
            own.StripVertical()
        there = np.array(osr.CoordinateTransformation(own, srs(code)).TransformPoints(
            np.column_stack([x.ravel(), y.ravel()])))
        x, y = there[:, 0].reshape(z.shape), there[:, 1].reshape(z.shape)
    return x, y, z, known, g[1]


def errors_of(plane, path='t.tif', code=None, rim=0):
    """(largest error of height [m], share of the plane's area known). Nodes within `rim` metres of the edge are left
    out; `code`: of the plane, where the terrain is in another system."""
    x, y, z, known, cell = nodes_of(plane, path, code)
    inside = known & (np.maximum(abs(x - plane.x0 - SIDE / 2), abs(y - plane.y0 - SIDE / 2)) <= SIDE / 2 - rim)
    error = np.abs(z - plane.z(x, y))
    if not known.any():
        return np.inf, 0.0
    return float(error[inside if rim else known].max()), float(inside.sum() * cell ** 2 / (SIDE - 2 * rim) ** 2)


def shift_of(hill, path='t.tif', code=None):
    """Of the nodes over the hill: the shift in plan that explains most of their errors, the root of the mean square
    and the largest error of height [m], and the share of the hill's square that is known."""
    x, y, z, known, cell = nodes_of(hill, path, code)
    inside = known & (np.maximum(abs(x - hill.x0 - SIDE / 2), abs(y - hill.y0 - SIDE / 2)) <= SIDE / 2 - 10)
    x, y, error = x[inside], y[inside], (z - hill.z(x, y))[inside]
    if error.size < 9:
        return np.inf, np.inf, np.inf, 0.0
    slopes = np.column_stack([hill.z(x + .5, y) - hill.z(x - .5, y), hill.z(x, y + .5) - hill.z(x, y - .5),
                              np.ones_like(error)])
    dx, dy, _ = np.linalg.lstsq(slopes, -error, rcond=None)[0]
    return float(np.hypot(dx, dy)), float(np.sqrt(np.mean(error ** 2))), float(np.abs(error).max()), \
        float(error.size * cell ** 2 / (SIDE - 20) ** 2)
