#!/usr/bin/env python3
"""Everyday deliveries, taken to a terrain by the hints of the tools, beside their truth.

Each is written as its sender writes it: its format, system, unit, order of columns, companions. The call is the one
that the file's name suggests; then its hints are obeyed, one a step. The ground has a hill, whose
slopes tell a shift in plan from one in height. Exit 1 where a row is off the truth or ends otherwise than expected.
Needs python3-gdal, numpy.
"""
import os
import re
import shlex
import shutil
import sys
import zipfile

from inputs import (FEET, SIDE, SURVEY_FEET, Hill, call, contours, dem, dxf, follow, gdal, hint_in, landxml, mesh,
                    np, ogr, polyline, shift_of, srs, terrain_of, write)
from study import Study

TABLE = []
TRN, TIN = 'talus-trn', 'talus-tin'


def delivery(words, tool, options, code, corner, steps=(), fill=(), then='', truth=None, heights=.3, height=1000.0):
    """A maker of a delivery. `code`, `corner`: the hill's system and south-west corner; `truth`: its system, where the
    terrain is in another; `steps`: the remedies of hints that are applied; `heights`: bound of the rms error [m]."""
    def add(make):
        TABLE.append((make, words, tool, shlex.split(options), Hill(height, code, *corner), steps, dict(fill), then,
                      truth, heights))
        return make
    return add


def zipped(path, *members):
    with zipfile.ZipFile(path, 'w', zipfile.ZIP_DEFLATED) as archive:
        for member in members:
            archive.write(member)
            os.remove(member)


def grid_text(path, hill, cell, head=True, digits=2):
    """An ASCII grid as agencies deliver it, without a system."""
    z = hill.cells(cell)
    words = f'ncols {z.shape[1]}\nnrows {z.shape[0]}\nxllcorner {hill.x0}\nyllcorner {hill.y0}\ncellsize {cell}\n'
    write(path, (words + 'NODATA_value -99999\n' if head else '') +
          '\n'.join(' '.join(f'{v:.{digits}f}' for v in row) for row in z) + '\n')


def columns(path, rows, head='', end='\n', comma=False, between=';'):
    words = [between.join(map(str, row)) for row in rows]
    text = (head + end if head else '') + end.join(words) + end
    write(path, text.replace('.', ',') if comma else text)


# --- elevation models ----------------------------------------------------------------------------

@delivery('swisstopo: GeoTIFF tiles in one zip, LV95, LN02', TRN, '', 'EPSG:2056', (2600000, 1200000), ['unzip'])
def swisstopo(hill):
    dem('all.tif', hill, 2, code='EPSG:2056+5728')
    for k, x in enumerate((0, 50)):
        gdal.Translate(f'swissalti3d_2600-{1200 + k}.tif', 'all.tif', srcWin=[x, 0, 50, 100])
    zipped('swissalti3d.zip', 'swissalti3d_2600-1200.tif', 'swissalti3d_2600-1201.tif')
    return 'swissalti3d.zip'


@delivery('one GeoTIFF in a zip, with a text beside it', TRN, '', 'EPSG:25832', (650000, 5200000))
def tif_in_zip(hill):
    dem('dgm1.tif', hill, 2)
    write('licence.txt', 'CC BY 4.0\n')
    zipped('dgm1.zip', 'dgm1.tif', 'licence.txt')
    return 'dgm1.zip'


@delivery('Land Tirol: DGM as ASCII grid with .prj of ESRI, GK West', TRN, '', 'EPSG:31254', (80000, 220000))
def land_tirol(hill):
    grid_text('dgm_5m.asc', hill, 5)
    system = srs('EPSG:31254')
    system.MorphToESRI()
    write('dgm_5m.prj', system.ExportToWkt())
    return 'dgm_5m.asc'


@delivery('the same to UTM', TRN, '--t-srs EPSG:25832', 'EPSG:31254', (80000, 220000), truth='EPSG:31254')
def land_tirol_to_utm(hill):
    return land_tirol(hill)


@delivery('Kartverket: western Norway in zone 33, NN2000', TRN, '', 'EPSG:25833', (-30000, 6735000))
def norway(hill):
    dem('dtm10.tif', hill, 5, code='EPSG:25833+5941')
    return 'dtm10.tif'


@delivery('USGS: state plane and heights in US survey feet', TRN, '', 'EPSG:26913', (480000, 4400000),
          ['gdal_translate', '--t-srs EPSG:26913'], truth='EPSG:26913')
def state_plane(hill):
    dem('m.tif', hill, 2, height_factor=1 / SURVEY_FEET)
    gdal.Warp('usgs_be.tif', 'm.tif', dstSRS='EPSG:2232', xRes=2 / SURVEY_FEET, yRes=2 / SURVEY_FEET, errorThreshold=0,
              resampleAlg='bilinear', dstNodata=-999999)
    data = gdal.Open('usgs_be.tif', 1)
    data.SetProjection(srs('EPSG:2232+6360').ExportToWkt())
    return 'usgs_be.tif'


@delivery('the same, with no word of the heights', TRN, '--t-srs EPSG:26913', 'EPSG:26913', (480000, 4400000),
          ['gdal_translate'], then='--vertical-crs EPSG:5703', truth='EPSG:26913')
def state_plane_without_heights(hill):
    state_plane(hill)
    gdal.Translate('county.tif', 'usgs_be.tif', outputSRS='EPSG:2232')
    return 'county.tif'


@delivery('Geobasis Bayern: DGM1 as XYZ, no system', TRN, '', 'EPSG:25832', (650000, 5300000), ['--crs EPSG:code'],
          {'EPSG:code': 'EPSG:25832'})
def bavaria(hill):
    z = hill.cells(2)
    columns('650_5300.xyz', [(f'{hill.x0 + 2 * j + 1:.2f}', f'{hill.y0 + SIDE - 2 * i - 1:.2f}', f'{z[i, j]:.2f}')
                             for i in range(100) for j in range(100)], between=' ')
    return '650_5300.xyz'


@delivery('IGN: RGE ALTI as tiles of ASCII grid in a folder, no system', TRN, '', 'EPSG:2154', (900000, 6500000),
          ['gdalbuildvrt', '--crs EPSG:code'], {'EPSG:code': 'EPSG:2154'})
def rge_alti(hill):
    os.mkdir('RGEALTI')
    dem('all.tif', hill, 5, nodata=-99999)
    for k, x in enumerate((0, 20)):
        gdal.Translate(f'RGEALTI/RGEALTI_0900_{6500 + k}_MNT.asc', 'all.tif', srcWin=[x, 0, 20, 40], format='AAIGrid')
    for name in os.listdir('RGEALTI'):
        if not name.endswith('.asc'):
            os.remove(f'RGEALTI/{name}')
    return 'RGEALTI'


@delivery('Italy: DTM in Monte Mario zone 1, no system in the file', TRN, '', 'EPSG:3003', (1650000, 5150000),
          ['--crs EPSG:code'], {'EPSG:code': 'EPSG:3003'})
def monte_mario(hill):
    grid_text('dtm.asc', hill, 5)
    return 'dtm.asc'


@delivery('the same, called UTM 32', TRN, '--crs EPSG:25832', 'EPSG:3003', (1650000, 5150000), ['--crs EPSG:code'],
          {'EPSG:code': 'EPSG:3003'})
def monte_mario_called_utm(hill):
    return monte_mario(hill)


@delivery('LINZ: DEM in NZTM, NZVD2016', TRN, '', 'EPSG:2193', (1570000, 5180000))
def new_zealand(hill):
    dem('dem_1m.tif', hill, 2, code='EPSG:2193+7839', nodata=-9999)
    return 'dem_1m.tif'


@delivery('Copernicus: DEM in degrees, EGM2008', TRN, '', 'EPSG:32632', (650000, 5200000), ['--t-srs EPSG:32632'],
          truth='EPSG:32632', heights=1)
def copernicus(hill):
    dem('m.tif', hill, 2)
    gdal.Warp('n46_e010.tif', 'm.tif', dstSRS='EPSG:4326', errorThreshold=0, resampleAlg='bilinear', dstNodata=-32767)
    data = gdal.Open('n46_e010.tif', 1)
    data.SetProjection(srs('EPSG:4326+3855').ExportToWkt())
    return 'n46_e010.tif'


@delivery('netCDF of a model', TRN, '', 'EPSG:25832', (650000, 5200000), ['gdal_translate'])
def netcdf(hill):
    dem('topo.nc', hill, 5, driver='netCDF')
    return 'topo.nc'


@delivery('scanned map: DEM with ground control points', TRN, '', 'EPSG:31287', (400000, 400000), ['gdalwarp'])
def control_points(hill):
    dem('m.tif', hill, 5, code='')
    places = [gdal.GCP(hill.x0 + 5 * a, hill.y0 + SIDE - 5 * b, 0, a, b) for a, b in ((0, 0), (40, 0), (40, 40), (0, 40))]
    gdal.Translate('scan.tif', 'm.tif', GCPs=places, outputSRS='EPSG:31287')
    return 'scan.tif'


@delivery('mine: local grid in feet', TRN, '', '', (5000, 9000), ['gdal_translate'], then='--crs none', height=300)
def local_feet(hill):
    dem('mine.tif', hill, 5, factor=1 / FEET, code='LOCAL_CS["mine grid",UNIT["foot",0.3048]]', kind=gdal.GDT_Float64)
    return 'mine.tif'


@delivery('Rockyfor3D: folder of rasters, its dem.asc', TRN, '--crs EPSG:21781', 'EPSG:21781', (600000, 200000))
def rockyfor3d(hill):
    os.mkdir('rf3d')
    grid_text('rf3d/dem.asc', hill, 2)
    for name in ('rockdensity', 'd1', 'd2', 'd3', 'rg70', 'rg20', 'rg10', 'soiltype', 'blshape', 'nrtrees', 'dbhmean'):
        write(f'rf3d/{name}.asc', f'ncols 100\nnrows 100\nxllcorner {hill.x0}\nyllcorner {hill.y0}\ncellsize 2\n'
                                  'NODATA_value -9999\n' + ('4 ' * 100 + '\n') * 100)
    return 'rf3d/dem.asc'


# --- contours, points, surfaces ------------------------------------------------------------------

@delivery('Austria: contours as shapefile, GK M28', TIN, '', 'EPSG:31257', (150000, 220000))
def gk_m28(hill):
    contours('hoehenlinien.shp', hill, field='HOEHE', driver='ESRI Shapefile')
    return 'hoehenlinien.shp'


@delivery('Austria: contours GK M31, no .prj', TIN, '', 'EPSG:31258', (450000, 270000), ['--crs EPSG:code'],
          {'EPSG:code': 'EPSG:31258'})
def gk_m31(hill):
    contours('hsl.shp', hill, field='HOEHE', driver='ESRI Shapefile', code='')
    return 'hsl.shp'


@delivery('the same with the full northing', TIN, '--crs EPSG:31258', 'EPSG:31285', (450000, 5270000), ['--crs EPSG:code'],
          {'EPSG:code': 'EPSG:31285'})
def gk_m31_in_full(hill):
    return gk_m31(hill)


@delivery('Austria: survey points GK M34, "Y;X;H" with decimal commas', TIN, '--points --crs EPSG:31259', 'EPSG:31259',
          (740000, 330000), heights=1.5)
def gk_m34(hill):
    rows = [(f'{x:.3f}', f'{y:.3f}', f'{z:.3f}') for x, y, z in hill.points(40)]
    columns('punkte.csv', rows, 'Rechtswert;Hochwert;H', '\r\n', comma=True)
    return 'punkte.csv'


@delivery('survey points "P,N,E,Z,D" without names of columns', TIN, '--points --crs EPSG:25832', 'EPSG:25832',
          (650000, 5200000), ['number,northing,easting,z'], heights=1.5)
def pnezd(hill):
    columns('topo.txt', [(1000 + k, f'{y:.3f}', f'{x:.3f}', f'{z:.3f}', 'GND')
                         for k, (x, y, z) in enumerate(hill.points(40))], between=',')
    return 'topo.txt'


@delivery('survey points with thousands parted by points', TIN, '--points --crs EPSG:25832', 'EPSG:25832',
          (650000, 5200000), ['without signs'], heights=1.5)
def thousands(hill):
    def parted(value):
        whole, rest = f'{value:.2f}'.split('.')
        return f'{int(whole):,}'.replace(',', '.') + ',' + rest
    columns('vermessung.csv', [tuple(map(parted, row)) for row in hill.points(40)], 'X;Y;Z')
    return 'vermessung.csv'


@delivery('CAD: contours as DXF in millimetres', TIN, '--crs EPSG:25832', 'EPSG:25832', (650000, 5200000),
          ['--unit-m 0.001'])
def cad(hill):
    dxf('lageplan.dxf', ''.join(polyline('HL', np.asarray(p)[:, :2] * 1000, z * 1000) for z, p in hill.contours()),
        '9\n$INSUNITS\n70\n4\n')
    return 'lageplan.dxf'


@delivery('Civil 3D: LandXML in US survey feet, existing and finished ground', TRN, '--crs EPSG:26913 --cell-size-m 5',
          'EPSG:26913', (480000, 4400000), ['--unit-m 0.3048006096', 'ground.xml|layername=EG'])
def civil(hill):
    vertices, faces = mesh(hill, 40)
    landxml('ground.xml', [('EG', vertices / SURVEY_FEET, faces), ('FG', vertices / SURVEY_FEET + [0, 0, 30], faces)],
            '<Imperial linearUnit="USSurveyFoot"/>')
    return 'ground.xml'


@delivery('swisstopo: contours as shapefile, LV95, .prj of ESRI', TIN, '', 'EPSG:2056', (2600000, 1200000))
def lv95_contours(hill):
    contours('swissTLM3D_hoehenkurve.shp', hill, field='', z=True, driver='ESRI Shapefile')
    system = srs('EPSG:2056')
    system.MorphToESRI()
    write('swissTLM3D_hoehenkurve.prj', system.ExportToWkt())
    return 'swissTLM3D_hoehenkurve.shp'


@delivery('contours as text in feet, name of the field says so', TIN, '', 'EPSG:25832', (650000, 5200000),
          ['--elevation-unit-m 0.3048'])
def contours_in_feet(hill):
    contours('contours.gpkg', hill, field='ELEV_FT', height_factor=1 / FEET, kind=ogr.OFTString, value=lambda z: f'{z:.4f}')
    return 'contours.gpkg'


@delivery('Google Earth: 3-D lines as KML', TIN, '', 'EPSG:32632', (650000, 5200000), ['--t-srs EPSG:32632'],
          truth='EPSG:32632')
def kml(hill):
    contours('m.gpkg', hill, field='', z=True, code='EPSG:32632')
    gdal.VectorTranslate('lines.kml', 'm.gpkg', format='KML', dstSRS='EPSG:4326', reproject=True)
    return 'lines.kml'


@delivery('the same as KMZ', TIN, '', 'EPSG:32632', (650000, 5200000), ['--t-srs EPSG:32632'], truth='EPSG:32632')
def kmz(hill):
    kml(hill)
    os.rename('lines.kml', 'doc.kml')
    zipped('lines.kmz', 'doc.kml')
    return 'lines.kmz'


@delivery('drone: OBJ of the ground, local metres', TRN, '--crs none --cell-size-m 5', '', (0, 0), height=20)
def drone(hill):
    vertices, faces = mesh(hill, 40)
    write('odm_textured_model_geo.obj', 'mtllib a.mtl\n' + ''.join(f'v {x:.4f} {y:.4f} {z:.4f}\n' for x, y, z in vertices) +
          'usemtl m\n' + ''.join('f ' + ' '.join(f'{i + 1}' for i in face) + '\n' for face in faces))
    return 'odm_textured_model_geo.obj'


@delivery('laser scan as LAZ', TRN, '', 'EPSG:25832', (650000, 5200000), ['REFUSED'])
def laser(_hill):
    write('scan.laz', b'LASF' + bytes(400))
    return 'scan.laz'


# --- the user ------------------------------------------------------------------------------------

def by_hand(way, source):
    """A step of a hint that no command does: (the new file, the words of the step)."""
    with open(source, encoding='utf-8') as file:
        text = file.read()
    if way.startswith('number,'):
        write('named.csv', way + ',code\n' + text)
        return 'named.csv', f'first line "{way},code"'
    write('plain.csv', text.replace('.', '').replace(',', '.'))
    return 'plain.csv', 'numbers without signs between thousands'


def check_import(source, options):
    """Contours and points that talus-import brings to one form first make the same terrain."""
    os.rename('t.tif', 'direct.tif')
    write('s.toml', '[site]\nname = "t"\n[terrain]\ncontours = "given"\n')
    given = f'terrain.contours={source}'
    code, _, err = call(['talus-import', 's.toml', '-o', 'inputs.gpkg', '--set', given, '--no-db', *options])
    assert code == 0, f'talus-import: {err}'
    accepted, err = terrain_of(TIN, 'inputs.gpkg', [word for word in options if word == '--points'])
    assert accepted, f'after talus-import: {err}'
    direct, imported = (gdal.Open(name).ReadAsArray() for name in ('direct.tif', 't.tif'))
    assert np.array_equal(direct, imported), 'after talus-import the terrain is another'


def taken(entry):
    """(steps, errors) of a delivery; no errors where it is refused."""
    make, _, tool, options, hill, ways, fill, then, truth, _ = entry
    source = make(hill)
    words = []
    accepted, err = terrain_of(tool, source, options)
    for way in ways:
        assert not accepted, f'accepted before "{way}": {err}'
        hint = hint_in(err)
        if way == 'REFUSED':
            return words, None
        if way in hint and not re.match(r'--|[\w.]+$', way) and '|' not in way:
            source, step = by_hand(way, source)
            words.append(step)
        else:
            given = list(options)
            source, options = follow(way, hint, source, options, fill, then, [])
            words.append(way if re.fullmatch(r'\w+', way) else source if '|' in way
                         else ' '.join(word for word in options if word not in given or word.startswith('--') and
                                       options[options.index(word) + 1:][:1] != given[given.index(word) + 1:][:1])
                         if options != given else way)
        accepted, err = terrain_of(tool, source, options)
    assert accepted, f'still refused: {err}'
    if tool == TIN:
        check_import(source, options)
    return words, shift_of(hill, 't.tif', truth)


def add_part(entry):
    """A part of the study: one delivery."""
    make, words, tool, options = entry[:4]

    @STUDY.part(make.__name__, 1)
    def compute(study):
        folder = study.out / make.__name__
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        os.chdir(folder)
        try:
            steps, errors = taken(entry)
        except Exception as why:
            sys.exit(f'FAILED: {make.__name__}: {type(why).__name__} {why}')
        said = {'given to': f'`{" ".join([tool, *options])}`',
                'steps, as the hints say': '; '.join(f"`{s}`" for s in steps).replace('|', '\\|') or '-'}
        if errors is not None:
            plan, rms, largest, known = errors
            if not (plan <= max(.3, entry[-1]) and rms <= entry[-1] and known >= .9):
                sys.exit(f'FAILED: {make.__name__}: {plan:.2f} m in plan, {rms:.2f} m in height, {100 * known:.0f} % known')
            said |= {'shift in plan [m]': f'{plan:.2f}', 'height, rms [m]': f'{rms:.2f}', 'height, largest [m]': f'{largest:.2f}'}
        study.row('all', words, said)


if __name__ == '__main__':
    STUDY = Study(__file__, __doc__)
    for one in TABLE:
        add_part(one)
    STUDY.main()
