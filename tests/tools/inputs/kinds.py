"""Inputs that came in wrong once, each kind in a second form than the one that was mended: the tools' result
is right, or they say what is wrong, or warn.

  kinds.py [NAME]...   (the tools on PATH; works in the folder that it is called in)
"""
import os
import re
import shlex
import shutil
import struct
import sys
import tarfile

from inputs import (CODE, FEET, SIDE, SURVEY_FEET, X0, Y0, Plane, call, contours, dem, errors_of, gdal, landxml,
                    mesh, np, ogr, osr, raster, shapes, square, srs, terrain_of, write)

TABLE = []
TRN, TIN = 'talus-trn', 'talus-tin'


def kind(tool, expected, options='', code=None, tolerance=.05, rim=0, plane=CODE, height=1000.0):
    """A maker of an input. `expected`: '' for the right ground, else what the refusal or a warning says."""
    def add(make):
        TABLE.append((make, tool, expected, shlex.split(options), code, tolerance, rim, plane, height))
        return make
    return add


# --- elevation models ----------------------------------------------------------------------------

@kind(TRN, 'the raster is rotated', height=-40)
def rotated_a_quarter(plane):
    raster('dem.img', plane.cells(), None, None, place=(X0, 0, 5, Y0, 5, 0), driver='HFA')
    return 'dem.img'


@kind(TRN, 'nan')
def capital_nan_first(plane):
    rows = [' '.join(f'{z:.2f}' for z in row) for row in plane.cells()]
    rows[0] = 'NaN' + rows[0][rows[0].index(' '):]
    write('dem.asc', f'ncols 40\nnrows 40\nxllcorner {X0}\nyllcorner {Y0}\ncellsize 5\nNODATA_value NaN\n' + '\n'.join(rows))
    write('dem.prj', srs(CODE).ExportToWkt())
    return 'dem.asc'


@kind(TRN, 'Gauss and Krueger', plane='EPSG:31468', options='--crs EPSG:25833')
def zone_4_called_utm(plane):
    plane.x0, plane.y0 = 4530000, 5300000
    dem('dem.asc', plane, code='', driver='AAIGrid')
    return 'dem.asc'


@kind(TRN, 'as decimetres the heights go from 1001')
def decimetres(plane):
    dem('dem.tif', plane, height_factor=10, kind=gdal.GDT_Int32)
    return 'dem.tif'


@kind(TRN, 'as centimetres the heights go from 11')
def centimetres_of_low_ground(plane):  # most cells below 9,000
    plane.z0 = 10
    dem('dem.tif', plane, height_factor=100, kind=gdal.GDT_Int32)
    return 'dem.tif'


@kind(TRN, 'colours')
def terrarium_with_alpha(plane):
    value = plane.cells() + 32768
    data = gdal.GetDriverByName('MEM').Create('', 40, 40, 4, gdal.GDT_Byte)
    data.SetGeoTransform((X0, 5, 0, Y0 + SIDE, 0, -5))
    for band, cells in enumerate((value // 256, value % 256, (value % 1) * 256, np.full_like(value, 255)), 1):
        data.GetRasterBand(band).WriteArray(cells.astype(np.uint8))
    gdal.GetDriverByName('PNG').CreateCopy('tile.png', data, options=['WORLDFILE=YES'])
    return 'tile.png'


@kind(TRN, 'seam|step')
def seam_along_a_row(plane):
    cells = plane.cells()
    cells[17:] += 12
    raster('dem.tif', cells, (X0, Y0 + SIDE), 5)
    return 'dem.tif'


@kind(TRN, 'seam')
def seam_of_a_tile_that_ends_inside(plane):
    cells = plane.cells()
    for name, rows, cols, datum in (('all', 40, 40, 0), ('west', 22, 18, .8)):
        raster(f'{name}.tif', cells[:rows, :cols] + datum, (X0, Y0 + SIDE), 5)
    gdal.BuildVRT('dem.vrt', ['all.tif', 'west.tif'])
    return 'dem.vrt'


@kind(TRN, 'seam')
def seams_of_three_tiles(plane):
    cells = plane.cells()
    for name, rows, cols, datum in (('a', slice(0, 21), slice(0, 40), 3), ('b', slice(21, 40), slice(0, 17), 0),
                                    ('c', slice(21, 40), slice(17, 40), .8)):
        raster(f'{name}.tif', cells[rows, cols] + datum, (X0 + 5 * cols.start, Y0 + SIDE - 5 * rows.start), 5)
    gdal.BuildVRT('dem.vrt', ['a.tif', 'b.tif', 'c.tif'])
    return 'dem.vrt'


def word_of_unit(word):
    @kind(TRN, '')
    def unit(plane):
        dem('dem.tif', plane, unit=word)
        return 'dem.tif'
    unit.__name__ = 'unit_' + re.sub(r'\W+', '_', word)


for unit_word in ('Meter', 'mètres', 'm ü. M.', 'metri', 'M', 'm NHN', 'none', '[m]', 'metres above sea level', 'masl'):
    word_of_unit(unit_word)


@kind(TRN, '', '--crs EPSG:25832', rim=5)
def control_points_that_shift_alone(plane):
    dem('m.tif', plane, code='')
    places = [gdal.GCP(X0 + 5 * a, Y0 + SIDE - 5 * b, 0, a, b) for a, b in ((0, 0), (40, 0), (20, 40))]
    gdal.Translate('gcps.vrt', 'm.tif', GCPs=places, outputSRS=CODE)
    code, _, err = call([TRN, 'gcps.vrt', '-o', 't.tif', '--no-db'])
    assert code == 1 and 'ground control points' in err, err
    code, _, err = call(re.search(r'gdalwarp .*', err)[0])
    assert code == 0, err
    return 'placed.tif'


@kind(TRN, '', '--window 650040,5200040,650160,5200160')
def extent_with_its_system(plane):
    dem('dem.tif', plane)
    code, _, err = call([TRN, 'dem.tif', '-o', 't.tif', '--no-db', '--window', '650040,650160,5200040,5200160 [EPSG:25832]'])
    assert code == 2 and 'XMIN,YMIN,XMAX,YMAX' in err, err
    code, _, err = call([TRN, 'dem.tif', '-o', 't.tif', '--no-db', '--window', '650040,650160,5200040,5200160'])
    assert code == 1 and '--window 650040,5200040,650160,5200160' in err, err
    return 'dem.tif'


@kind(TRN, 'archive|tar|unpack')
def tiles_in_tar_gz(plane):
    dem('dem.tif', plane)
    with tarfile.open('dem.tar.gz', 'w:gz') as archive:
        archive.add('dem.tif')
    os.remove('dem.tif')
    return 'dem.tar.gz'


@kind(TIN, 'an elevation model is for talus-trn')
def elevation_model_as_contours(plane):
    dem('dem.tif', plane)
    return 'dem.tif'


@kind(TRN, 'made by talus-tin')
def contours_as_elevation_model(plane):
    contours('map.gpkg', plane)
    return 'map.gpkg'


@kind(TIN, 'save it as DXF')
def drawing_of_2013(_plane):
    write('plan.dwg', b'AC1027' + bytes(500))
    return 'plan.dwg'


@kind(TRN, 'unpack it')
def delivery_in_7z(_plane):
    write('RGEALTI.7z', b"7z\xbc\xaf'\x1c" + bytes(200))
    return 'RGEALTI.7z'


@kind(TRN, 'export it with faces; points alone as text')
def cloud_as_ply(plane):
    points = plane.points()
    write('cloud.ply', f'ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n'
          'property double z\nend_header\n' + ''.join(f'{x} {y} {z}\n' for x, y, z in points.tolist()))
    return 'cloud.ply'


@kind(TIN, 'laser scan')
def scan_as_e57(_plane):
    write('scan.e57', b'ASTM-E57' + bytes(400))
    return 'scan.e57'


@kind(TRN, '', '--crs EPSG:25833 --window 300000,7000000,300100,7000100')
def whole_country_in_one_zone(plane):
    plane.x0, plane.y0 = 300000, 7000000
    cells = np.zeros((400, 400), np.float32)
    cells[:] = plane.z(0, 7000200 - 2500 - 5000 * np.arange(400) + 1e6)[:, None]
    dem('t0.tif', plane, code='EPSG:25833')
    gdal.Warp('dem.vrt', 't0.tif', outputBounds=(-76000, 6450000, 1120000, 7940000), xRes=5, yRes=5, format='VRT',
              dstNodata=-9999)
    return 'dem.vrt'


@kind(TRN, '', plane='EPSG:3067')
def finland_west_of_its_zone(plane):
    plane.x0, plane.y0 = 70000, 6700000
    dem('dem.tif', plane, code='EPSG:3067')
    return 'dem.tif'


# --- contours and points -------------------------------------------------------------------------

@kind(TIN, 'nothing says what unit the heights are in', '--t-srs EPSG:26918', plane='EPSG:26918')
def contours_of_new_york(plane):
    plane.x0, plane.y0 = 600000, 4510000
    contours('m.gpkg', plane, field='CONTOUR', height_factor=1 / SURVEY_FEET)
    gdal.VectorTranslate('map.shp', 'm.gpkg', dstSRS='EPSG:2263', reproject=True, format='ESRI Shapefile')
    return 'map.shp'


@kind(TIN, '', '--t-srs EPSG:32719', code='EPSG:32619', plane='EPSG:32619')
def contours_below_zero(plane):
    plane.x0, plane.y0 = 500000, -1650000
    contours('map.gpkg', plane)
    return 'map.gpkg'


def table(path, plane, form, head='', n=20):
    write(path, head + ''.join(form(k, x, y, z) + '\n' for k, (x, y, z) in enumerate(plane.points(n).tolist())))
    return path


@kind(TIN, 'column', '--points --crs EPSG:25832')
def pnezd_with_blanks(plane):
    return table('list.txt', plane, lambda k, x, y, z: f'{17 * k % 401 + 100} {y:.3f} {x:.3f} {z:.3f} TOE')


@kind(TIN, 'column|number', '--points --crs none')
def pnezd_local_letters(plane):
    plane.x0, plane.y0 = 1000, 500
    return table('list.csv', plane, lambda k, x, y, z: f'A{k},{y:.3f},{x:.3f},{z:.3f},GND')


@kind(TIN, 'exchanged', '--points --crs EPSG:25832')
def hochwert_first(plane):
    return table('list.csv', plane, lambda k, x, y, z: f'{y:.2f};{x:.2f};{z:.2f}', 'X;Y;H\n')


@kind(TIN, 'point number', '--points --crs none')
def pnez_of_whole_metres(plane):
    plane.x0, plane.y0 = 1000, 500
    return table('list.csv', plane, lambda k, x, y, z: f'{17 * k % 401 + 100},{y:.0f},{x:.0f},{z:.0f}')


@kind(TIN, 'stands before x', '--points --crs none')
def local_y_before_x(plane):
    plane.x0, plane.y0 = 1000, 500
    return table('list.csv', plane, lambda k, x, y, z: f'{x:.2f};{y:.2f};{z:.2f}', 'Y;X;H\n')


def parted(sign, point):
    @kind(TIN, 'thousands|expected a number', '--points --crs EPSG:25832')
    def thousands(plane):
        def number(v):
            return f'{v:,.2f}'.replace('.', '#').replace(',', sign).replace('#', point)
        return table('list.csv', plane, lambda k, x, y, z: f'{number(x)};{number(y)};{number(z)}', 'x;y;z\n')
    thousands.__name__ = f'thousands_{ord(sign)}_{ord(point)}'


for sign_of_thousands, decimal in (("'", '.'), (' ', ','), ('.', ','), (',', '.')):
    parted(sign_of_thousands, decimal)


@kind(TIN, 'says "1,000", expected an elevation')
def heights_in_thousands_with_comma(plane):
    contours('map.gpkg', plane, kind=ogr.OFTString, value=lambda z: f'{z:,.0f}')
    return 'map.gpkg'


@kind(TIN, 'rows|records')
def one_row_too_many(plane):
    contours('map.shp', plane, driver='ESRI Shapefile')
    with open('map.dbf', 'r+b') as file:
        head = bytearray(file.read())
        n, at, size = struct.unpack('<IHH', head[4:12])
        body = bytes(head[at:at + size * n])
        head[4:8] = struct.pack('<I', n + 1)
        file.seek(0)
        file.write(bytes(head[:at]) + body[:size] + body + b'\x1a')
    return 'map.shp'


@kind(TIN, 'spot|breakline', '--breaklines cross.gpkg --spots spots.gpkg')
def spot_on_a_breakline(plane):
    contours('map.gpkg', plane)
    y = Y0 + 105.0
    shapes('cross.gpkg', [(f'LINESTRING Z ({X0 + 40} {y} {plane.z(0, y)}, {X0 + 160} {y} {plane.z(0, y)})', {})])
    shapes('spots.gpkg', [(f'POINT Z ({X0 + 100} {y} {plane.z(0, y) + 3.5})', {})])
    return 'map.gpkg'


def two_spots(step):
    @kind(TIN, 'spot height at 105[58] m', '--spots spots.gpkg')
    def spots(plane):
        contours('map.gpkg', plane)
        shapes('spots.gpkg', [(f'POINT Z ({X0 + 100 + gap} {Y0 + 110} {1055 + z})', {}) for gap, z in ((0, 0), (.05, step))])
        return 'map.gpkg'
    spots.__name__ = f'spots_5_cm_apart_{step}_m'.replace('-', 'minus_')


for step_of_spots in (3, -3):
    two_spots(step_of_spots)


@kind(TIN, 'point at 1058 m', '--points --crs EPSG:25832')
def points_5_cm_apart(plane):
    table('list.csv', plane, lambda k, x, y, z: f'{x:.3f},{y:.3f},{z:.3f}', 'x,y,z\n')
    with open('list.csv', 'a', encoding='utf-8') as file:
        file.write(f'{X0 + 100},{Y0 + 110},1055\n{X0 + 100},{Y0 + 110.05},1058\n')
    return 'list.csv'


@kind(TIN, '--crs none --unit-m 0.3048006096 scales',
      """--points --crs 'LOCAL_CS["site",UNIT["US survey foot",0.3048006096012192]]'""")
def table_of_local_feet(plane):
    return table('list.csv', plane, lambda k, x, y, z: f'{x / FEET:.3f},{y / FEET:.3f},{z / FEET:.3f}', 'x,y,z\n')


@kind(TIN, '')
def contours_far_west(plane):
    plane.x0, plane.y0, plane.code = -30000, 6735000, 'EPSG:25833'
    contours('map.gpkg', plane)
    return 'map.gpkg'


# --- surfaces ------------------------------------------------------------------------------------

@kind(TRN, '2 surfaces', '--crs EPSG:25832 --cell-size-m 5 --unit-m 0.3048')
def landxml_of_two_in_feet(plane):
    vertices, faces = mesh(plane)
    landxml('two.xml', [('Natural Ground', vertices / FEET, faces), ('Design', vertices / FEET + [0, 0, 9], faces)],
            '<Imperial linearUnit="foot"/>')
    return 'two.xml'


@kind(TRN, '', '--crs EPSG:25832 --cell-size-m 5')
def mesh_as_obj(plane):
    vertices, faces = mesh(plane)
    write('ground.obj', 'o ground\n' + ''.join(f'v {x} {y} {z}\n' for x, y, z in vertices.tolist()) +
          'vt 0 0\n' + ''.join('f ' + ' '.join(f'{i + 1}/1' for i in face) + '\n' for face in faces))
    return 'ground.obj'


@kind(TRN, 'is y the height', '--crs none --cell-size-m 5')
def mesh_with_y_up(plane):
    plane.x0 = plane.y0 = 0
    plane.z0 = 0
    vertices, faces = mesh(plane)
    write('ground.obj', ''.join(f'v {x} {z} {-y}\n' for x, y, z in vertices.tolist()) +
          ''.join('f ' + ' '.join(f'{i + 1}' for i in face) + '\n' for face in faces))
    return 'ground.obj'


def obj(path, vertices, faces):
    write(path, ''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in vertices.tolist()) +
          ''.join('f ' + ' '.join(f'{i + 1}' for i in face) + '\n' for face in faces))
    return path


@kind(TRN, '--window 650040,5200040,650160,5200160', '--crs EPSG:25832 --cell-size-m 5 --window 650040,650160,5200040,5200160')
def extent_of_a_mesh(plane):
    return obj('ground.obj', *mesh(plane))


@kind(TRN, 'single precision', '--crs EPSG:25832 --cell-size-m 5', tolerance=.2)
def mesh_in_single_precision(plane):
    plane.x0, plane.y0 = X0 + .37, Y0 + .41
    vertices, faces = mesh(plane)
    return obj('ground.obj', vertices.astype(np.float32).astype(float), faces)


# --- what lies on the ground ---------------------------------------------------------------------

SITE = '[site]\nname = "t"\ncrs = "{code}"\n'
BLOCK = '[blocks.b]\nshape = "box"\nsize_m = [1, 1, 1]\nposition_m = [650100, 5200150]\n'
END = '[material.rock]\n[solver]\nduration_s = 0.1\n'


def run(text, expected, code=CODE, encoding='utf-8', tool='talus-dda'):
    """A site on trn.tif: its run or its blocks end well and do not mention it, or say the expected words."""
    with open('s.toml', 'w', encoding=encoding) as file:
        file.write(SITE.format(code=code) + text)
    status, out, err = call(['talus-blocks', 's.toml', '--trn', 'trn.tif', '-o', 'b.h5', '--no-db', '--overwrite'])
    said = out + err
    if status == 0 and tool == 'talus-dda':
        status, out, err = call(['talus-dda', 's.toml', '--trn', 'trn.tif', '--blocks', 'b.h5', '-o', 'r.h5', '--no-db',
                                 '--overwrite'])
        said += out + err
    assert status in (0, 1), said
    assert re.search(expected, said), f'expected: {expected}; it says: {said}'
    return status, said


def on_site(make):
    """A row that makes a site and asks it itself."""
    TABLE.append((make, 'site', '', [], None, 0, 0, CODE, 1000.0))
    return make


def joints(lines):
    sets = [('b', 80, 0), ('c', 85, 90)]
    return ('[source]\npolygon = [[650060, 5200060], [650140, 5200060], [650140, 5200140], [650060, 5200140]]\n'
            'failure_surface = "normal_depth"\ndepth_m = 5\n' + lines +
            ''.join(f'[joints.{n}]\ndip_deg = {d}\ndip_direction_deg = {a}\nspacing_m = 8\n' for n, d, a in sets) +
            '[material.rock]\n')


@on_site
def ply_of_single_precision(plane):
    x, y = 650100.37, 5200100.61
    corners = [(x + a, y + b, plane.z(x, y) + 1 + c) for c in (0, 1.1) for b in (0, 1.3) for a in (0, 2)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    write('rock.ply', b'ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n'
          b'property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n' +
          b''.join(struct.pack('<3f', *c) for c in corners) + b''.join(struct.pack('<B4i', 4, *f) for f in faces))
    run('[blocks.b]\nfile = "rock.ply"\n[material.rock]\n', 'precision|rounded', tool='talus-blocks')


@on_site
def obj_of_seven_digits(plane):
    x, y = 650100.37, 5200100.61
    corners = [(x + a, y + b, plane.z(x, y) + 1 + c) for c in (0, 1.1) for b in (0, 1.3) for a in (0, 2)]
    faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    write('rock.obj', ''.join('v %.7g %.7g %.7g\n' % c for c in corners) + ''.join('f %d %d %d %d\n' % f for f in faces))
    run('[blocks.b]\nfile = "rock.obj"\n[material.rock]\n', 'warning: .* 7 digits', tool='talus-blocks')


@on_site
def motion_in_utf16(_plane):
    with open('q.csv', 'w', encoding='utf-16') as file:
        file.write('time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n1,1,0,0\n')
    run(BLOCK + END + '[base_motion]\nfile = "q.csv"\n', 'iconv -f UTF-16')


@on_site
def backslash_u_in_a_path(_plane):
    run('[blocks.b]\nfile = "D:\\users\\rock.obj"\n' + END, 'write / in paths')


@on_site
def backslashes_in_single_quotes(_plane):
    run("[blocks.b]\nfile = 'data\\rock.obj'\n" + END, 'write / between folders')


@on_site
def joints_in_german_degrees(_plane):
    rows = ''.join(f'{200 + k % 7};{40 + k % 5}\n' for k in range(40))
    write('j.csv', 'Fallrichtung [Grad];Fallwinkel [Grad]\n' + rows)
    run(joints('[joints.a]\nmeasured_file = "j.csv"\nspacing_m = 8\n'), 'two meanings', tool='talus-blocks')


@on_site
def stems_in_inches(plane):
    places = [(f'POINT ({X0 + 5 + 10 * i} {Y0 + 5 + 10 * j})', {'dbh_cm': 3500.0}) for i in range(19) for j in range(19)]
    shapes('stems.gpkg', places, fields=[('dbh_cm', ogr.OFTReal)])
    run(BLOCK + END + '[forest.f]\nstems_file = "stems.gpkg"\n', 'dbh_cm is 3500, expected above 0 to 1000')


@on_site
def layer_in_the_singular(plane):
    rows = [(square(plane), {'name': 'meadow'})]
    shapes('site.gpkg', rows, layer='Grounds', fields=[('name', ogr.OFTString)])
    run('layers = "site.gpkg"\n' + BLOCK + END, '(?i)layer.*grounds')


@on_site
def classes_with_oblong_cells(plane):
    raster('classes.tif', np.zeros((40, 20)), None, None, place=(X0, 10, 0, Y0 + SIDE, 0, -5), kind=gdal.GDT_Byte)
    status, said = run('[terrain]\nground_raster = "classes.tif"\n[ground.smooth]\nfriction_deg = 5\nraster_values = [0]\n'
                       '[ground.elsewhere]\nfriction_deg = 50\n' + BLOCK + END, '')
    assert status == 0 or 'gdalwarp' in said and '-dstnodata' in said, said


@on_site
def classes_that_begin_with_nan(_plane):
    write('classes.asc', f'ncols 40\nnrows 40\nxllcorner {X0}\nyllcorner {Y0}\ncellsize 5\nNODATA_value nan\n' +
          ' '.join(['nan'] * 5 + ['0'] * 35) + '\n' + ('0 ' * 40 + '\n') * 39)
    is_read = int(gdal.VersionInfo()) >= 3100000
    run('[terrain]\nground_raster = "classes.asc"\n[ground.smooth]\nfriction_deg = 5\nraster_values = [0]\n'
        '[ground.elsewhere]\nfriction_deg = 50\n' + BLOCK + END, '' if is_read else 'sed .* > known.asc')


@on_site
def ground_across_180(plane):
    degrees, fiji = srs('EPSG:4326'), srs('EPSG:3460')
    there, back = osr.CoordinateTransformation(degrees, fiji), osr.CoordinateTransformation(fiji, degrees)
    x, y, _ = there.TransformPoint(179.9999999, -16.8)
    x0, y0 = round(x - 100), round(y, -1)
    dem('fiji.tif', Plane(500, 'EPSG:3460', x0, y0))
    call(['talus-trn', 'fiji.tif', '-o', 'trn.tif', '--no-db', '--overwrite'])
    (w, s, _), (e, n, _) = back.TransformPoint(x0 + 60, y0 + 60), back.TransformPoint(x0 + 150, y0 + 140)
    area = f'POLYGON (({w} {s}, {e + 360} {s}, {e + 360} {n}, {w} {n}, {w} {s}))'
    shapes('rock.geojson', [(area, {})], 'EPSG:4326', 'GeoJSON')
    block = BLOCK.replace('650100, 5200150', f'{x0 + 100}, {y0 + 100}')
    _, said = run('[ground.rock]\npolygon_file = "rock.geojson"\nfriction_deg = 30\n'
                  '[ground.elsewhere]\nfriction_deg = 35\n' + block + END, '', 'EPSG:3460')
    assert 'refused' not in said and 'lie outside' not in said, said


@on_site
def windows_utf16_big_endian(plane):
    status, _ = run(BLOCK + END, 'UTF-8.*(save|iconv|write)|iconv', encoding='utf-16-be')
    assert status == 1


@on_site
def windows_mark_and_line_ends(plane):
    status, said = run((BLOCK + END).replace('\n', '\r\n'), '', encoding='utf-8-sig')
    assert status == 0, said


@on_site
def gon_in_round_brackets(plane):
    rows = [(200 + k % 7, 40 + k % 5) for k in range(40)]
    write('j.csv', 'Fallrichtung (gon);Fallwinkel (gon)\n' + ''.join(f'{a / .9:.0f};{d / .9:.0f}\n' for a, d in rows))
    run(joints('[joints.a]\nmeasured_file = "j.csv"\nspacing_m = 8\n'), '40 orientations', tool='talus-blocks')


@on_site
def stand_in_int8_with_nodata(plane):
    for name, value in (('nr', 200), ('dbh', 35)):
        cells = np.full((10, 10), value)
        cells[:5] = 255
        raster(f'{name}.tif', cells, (X0, Y0 + SIDE), 20, kind=gdal.GDT_Byte, nodata=255)
    status, said = run(BLOCK + END + '[forest.f]\nnrtrees_raster = "nr.tif"\ndbhmean_raster = "dbh.tif"\n', '')
    assert status == 0 and re.search(r'forest.f: (3[5-9]\d|4\d\d) stems', said), said


@on_site
def folder_of_rockyfor3d(_plane):
    head = f'ncols 40\nnrows 40\nxllcorner {X0}\nyllcorner {Y0}\ncellsize 5\nNODATA_value -9999\n'
    for name, value in (('soiltype', 4), ('nrtrees', 300), ('dbhmean', 35), ('dbhstd', 8), ('conif_percent', 80)):
        write(f'{name}.asc', head + (f'{value} ' * 40 + '\n') * 40)
    status, said = run('[terrain]\nground_raster = "soiltype.asc"\n[ground.scree]\nraster_values = [4]\nfriction_deg = 35\n'
                       '[ground.elsewhere]\nfriction_deg = 20\n' + BLOCK + END + '[forest.f]\n' +
                       ''.join(f'{name}_raster = "{name}.asc"\n' for name in ('nrtrees', 'dbhmean', 'dbhstd', 'conif_percent')),
                       'conifers 80')
    assert status == 0, said


@on_site
def reference_raster_in_feet(plane):
    plane = Plane(1000, 'EPSG:26912', 450000, 4400000)
    dem('map.tif', plane)
    dem('feet.img', plane, height_factor=1 / SURVEY_FEET, driver='HFA')
    gdal.Translate('ref.vrt', 'feet.img', outputSRS='EPSG:26912+6360')
    status, out, err = call([TRN, 'map.tif', '-o', 't.tif', '--no-db', '--reference', 'ref.vrt'])
    assert status == 1 and 'US survey foot' in err or 'RMSE 0' in out, out + err


# --- the test ------------------------------------------------------------------------------------

def judge(entry):
    make, tool, expected, options, code, tolerance, rim, system, height = entry
    plane = Plane(height, system)
    if tool == 'site':
        dem('dem.tif', plane)
        call(['talus-trn', 'dem.tif', '-o', 'trn.tif', '--no-db'])
        make(plane)
        return
    source = make(plane)
    accepted, said = terrain_of(tool, source, options)
    if accepted:
        error, _ = errors_of(plane, code=code, rim=rim)
        warned = '\n'.join(row for row in said.splitlines() if 'warning' in row)
        assert error <= tolerance or expected and re.search(expected, warned), f'accepted, {error:.2f} m off: {said}'
    else:
        assert expected and re.search(expected, said), f'refused, expected: {expected or "the ground"}: {said}'


def main(wanted):
    failed = 0
    for entry in TABLE:
        name = entry[0].__name__
        if wanted and name not in wanted:
            continue
        shutil.rmtree(name, ignore_errors=True)
        os.mkdir(name)
        os.chdir(name)
        try:
            judge(entry)
            print('passed:', name)
        except Exception as why:
            failed += 1
            print(f'FAILED: {name}: {type(why).__name__} {why}')
        os.chdir('..')
    return failed


if __name__ == '__main__':
    sys.exit(1 if main(sys.argv[1:]) else 0)
