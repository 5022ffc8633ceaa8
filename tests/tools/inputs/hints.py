"""Each hint that holds a command or an option is obeyed until the tool accepts: in at most two steps. The terrain is
compared with the truth. It is ground from -50 to 50 m, where a rim of zeros would pass for ground, if a row says no other.

  hints.py SOURCE [NAME]...   (the tools on PATH; works in the folder that it is called in)

A row of the table makes an input that leads to a hint and says which of its ways to take. At the end each command of
the shell and each option that the hints in the sources hold must have been said by a row.
"""
import os
import pathlib
import re
import shlex
import shutil
import sqlite3
import sys
import tarfile
import zipfile
from xml.sax.saxutils import escape

from inputs import (CODE, FEET, SHELL, SIDE, SURVEY_FEET, X0, Y0, Plane, call, commands_in, contours, dem, dxf,
                    errors_of, follow, gdal, hint_in, landxml, line, made_by, mesh, np, ogr, osr, polyline,
                    raster, shapes, square, srs, terrain_of, write)

TABLE = []


def row(tool, finding, *ways, options='', code=None, fill=(), tolerance=.05, share=.9, rim=0, plane=CODE, then=''):
    """A maker of an input: its finding, and the ways of its hint that are taken.

    A way is the first word of a command of the shell, or words of the hint that begin with an option, or "leave
    --option". `fill`: values for EPSG:code and its like; `code`: the plane's, where the terrain is in another;
    `then`: options for what the command made."""
    def add(make):
        TABLE.append((make, tool, finding, ways, shlex.split(options), dict(fill), then,
                      {'code': code, 'rim': rim}, tolerance, share, plane))
        return make
    return add


TRN, TIN = 'talus-trn', 'talus-tin'


# --- elevation models ----------------------------------------------------------------------------

def warp(to, source, code):
    gdal.Warp(to, source, dstSRS=code, resampleAlg='bilinear', dstNodata=float('nan'), errorThreshold=0)


def far_west(plane):
    plane.x0, plane.y0 = 450000, 4400000
    return plane


@row(TRN, 'expected squares', 'gdalwarp')
def oblong(plane):
    cells = plane.cells(4)[:, :40]
    raster('dem.tif', cells, None, None, place=(X0, 5, 0, Y0 + SIDE, 0, -4))
    return 'dem.tif'


@row(TRN, 'the raster is rotated', 'gdalwarp', rim=40)
def rotated(plane):
    place = (X0, 5 * np.cos(.17), 5 * np.sin(.17), Y0 + SIDE - 30, 5 * np.sin(.17), -5 * np.cos(.17))
    col, line_ = np.meshgrid(np.arange(36) + .5, np.arange(36) + .5)
    raster('dem.tif', plane.z(0, place[3] + col * place[4] + line_ * place[5]), None, None, place=place)
    return 'dem.tif'


@row(TRN, 'do not run from north to south', 'gdalwarp')
def southern_row_first(plane):
    raster('dem.tif', plane.cells()[::-1], None, None, place=(X0, 5, 0, Y0, 0, 5))
    return 'dem.tif'


@row(TRN, 'in degrees', '--t-srs EPSG:32632', code=CODE, rim=15)
def in_degrees(plane):
    dem('metres.tif', plane, 1)
    warp('dem.tif', 'metres.tif', 'EPSG:4326')
    return 'dem.tif'


@row(TRN, 'in US survey foot of 0.3048006096 m', '--t-srs EPSG:26912', code='EPSG:26912', plane='EPSG:26912', rim=15,
     options='--vertical-crs EPSG:5703')
def plan_in_feet(plane):
    dem('metres.tif', far_west(plane))
    warp('dem.tif', 'metres.tif', 'EPSG:3566')
    return 'dem.tif'


@row(TRN, 'nothing says what unit the heights are in', '--vertical-crs EPSG:5703', code='EPSG:26912', plane='EPSG:26912',
     rim=15, options='--t-srs EPSG:26912')
def heights_in_metres(plane):
    return plan_in_feet(plane)


@row(TRN, 'nothing says what unit the heights are in', 'gdal_translate', code='EPSG:26912', plane='EPSG:26912',
     rim=15, options='--t-srs EPSG:26912', then='--vertical-crs EPSG:5703')
def all_in_feet(plane):
    dem('metres.tif', far_west(plane), height_factor=1 / SURVEY_FEET)
    warp('dem.tif', 'metres.tif', 'EPSG:3566')
    return 'dem.tif'


@row(TRN, 'ground control points', 'gdalwarp', options='--crs EPSG:25832', rim=5)
def control_points(plane):
    dem('plane.tif', plane, code='')
    n = gdal.Open('plane.tif').RasterXSize
    gcps = [gdal.GCP(X0 + 5 * a, Y0 + SIDE - 5 * b, 0, a, b) for a, b in ((0, 0), (n, 0), (n, n), (0, n))]
    gdal.Translate('dem.tif', 'plane.tif', GCPs=gcps, outputSRS=CODE)
    return 'dem.tif'


@row(TRN, 'no place on the map', 'gdal_translate', options='--crs EPSG:25832',
     fill={'XMIN YMAX XMAX YMIN': f'{X0} {Y0 + SIDE} {X0 + SIDE} {Y0}'})
def without_place(plane):
    cells = plane.cells()
    data = gdal.GetDriverByName('GTiff').Create('dem.tif', *cells.shape[::-1], 1, gdal.GDT_Float32)
    data.GetRasterBand(1).WriteArray(cells)
    return 'dem.tif'


def in_unit(unit, size, kind=gdal.GDT_Float64):
    @row(TRN, f'the elevations are in "{unit}"', 'gdal_translate')
    def in_a_unit(plane):
        dem('dem.tif', plane, height_factor=1 / size, unit=unit, kind=kind)
        return 'dem.tif'
    in_a_unit.__name__ = f'unit_{unit}'


for name, metres in (('dm', .1), ('cm', .01), ('mm', .001), ('ft', FEET), ('US survey foot', SURVEY_FEET)):
    in_unit(name, metres)
in_unit('Meereshoehe', 1)


@row(TRN, 'as centimetres the heights go', 'gdal_translate')
def whole_centimetres(plane):
    plane.z0 = max(plane.z0, 1000)  # low ground in centimetres may as well be in metres
    dem('dem.tif', plane, height_factor=100, kind=gdal.GDT_Int32)
    return 'dem.tif'


@row(TRN, 'as decimetres the heights go', 'gdal_translate#1', tolerance=.051)
def whole_decimetres(plane):
    plane.z0 = max(plane.z0, 1000)
    dem('dem.tif', plane, height_factor=10, kind=gdal.GDT_Int32)
    return 'dem.tif'


@row(TRN, 'as feet the heights go', 'gdal_translate')
def high_ground_in_feet(plane):
    plane.z0 = 3000
    dem('dem.tif', plane, height_factor=1 / FEET)
    return 'dem.tif'


def grid_with_nan(plane, at):
    cells = plane.cells()
    cells[at:at + 3, :8] = np.nan
    rows = '\n'.join(' '.join(f'{z:.2f}' for z in row) for row in cells)
    write('dem.asc', f'ncols 40\nnrows 40\nxllcorner {X0}\nyllcorner {Y0}\ncellsize 5\nNODATA_value nan\n{rows}\n')
    return 'dem.asc'


if int(gdal.VersionInfo()) < 3100000:  # GDAL 3.10 reads them
    @row(TRN, 'that begins with nan', 'sed', options='--crs EPSG:25832', share=.8)
    def nan_first(plane):
        return grid_with_nan(plane, 0)


@row(TRN, 'rows 0 to 39', 'sed', options='--crs EPSG:25832', share=.8)
def na_first(plane):
    rows = [' '.join(f'{z:.2f}' for z in row) for row in plane.cells()]
    rows[:3] = [' '.join(['NA'] * 8 + row.split()[8:]) for row in rows[:3]]
    write('dem.asc', f'ncols 40\nnrows 40\nxllcorner {X0}\nyllcorner {Y0}\ncellsize 5\nNODATA_value NA\n' + '\n'.join(rows))
    return 'dem.asc'


@row(TRN, '8 bits', 'gdal_translate', tolerance=.6)
def bytes_of_heights(plane):
    plane.z0 = 20
    dem('dem.tif', plane, kind=gdal.GDT_Byte)
    return 'dem.tif'


@row(TRN, 'with heights in', 'gdal_translate', plane='EPSG:26912')
def system_of_heights_in_feet(plane):
    dem('dem.img', far_west(plane), height_factor=1 / SURVEY_FEET, code='EPSG:26912', driver='HFA', kind=gdal.GDT_Float64)
    gdal.Translate('dem.vrt', 'dem.img', outputSRS='EPSG:26912+6360')
    return 'dem.vrt'


@row(TRN, 'in foot of', 'gdal_translate', then='--crs none')
def local_feet(plane):
    dem('dem.tif', plane, factor=1 / FEET, code='LOCAL_CS["site",UNIT["foot",0.3048]]', kind=gdal.GDT_Float64)
    return 'dem.tif'


def in_local_feet(to, source):
    """A VRT whose system is local feet with heights in metres, which a GeoTIFF cannot say."""
    system = osr.SpatialReference()
    system.ImportFromWkt('COMPD_CS["c",LOCAL_CS["site",UNIT["foot",0.3048]],VERT_CS["v",VERT_DATUM["d",2005],'
                         'UNIT["metre",1],AXIS["Up",UP]]]')
    gdal.Translate(to, source)
    with open(to, encoding='utf-8') as file:
        words = file.read()
    write(to, words.replace('<GeoTransform>', f'<SRS>{escape(system.ExportToWkt())}</SRS><GeoTransform>'))
    return to


@row(TRN, 'in foot of', 'gdal_translate', then='--crs none')
def local_feet_with_heights_in_metres(plane):
    dem('dem.tif', plane, factor=1 / FEET, height_factor=1, code='', kind=gdal.GDT_Float64)
    return in_local_feet('dem.vrt', 'dem.tif')


@row(TIN, 'in units of 0.3048 m', '--crs none --unit-m 0.3048', options="""--points --crs 'LOCAL_CS["site",UNIT["foot",0.3048]]'""",
     tolerance=.1)
def table_in_local_feet(plane):
    write('list.csv', 'x,y,z\n' + ''.join(f'{x / FEET:.3f},{y / FEET:.3f},{z / FEET:.3f}\n' for x, y, z in plane.points(20)))
    return 'list.csv'


@row(TRN, 'in foot of', '--crs none --unit-m 0.3048', options="""--cell-size-m 5 --crs 'LOCAL_CS["site",UNIT["foot",0.3048]]'""")
def mesh_in_local_feet(plane):
    vertices, triangles = mesh(plane)
    write('ground.obj', ''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in (vertices / FEET).tolist()) +
          ''.join('f ' + ' '.join(f'{i + 1}' for i in face) + '\n' for face in triangles))
    return 'ground.obj'


@row(TIN, 'SHAPE_RESTORE_SHX', 'ogr2ogr')
def shapefile_without_index(plane):
    contours('map.shp', plane, driver='ESRI Shapefile')
    os.remove('map.shx')
    return 'map.shp'


@row(TIN, 'in units of 0.3048 m', '--unit-m 0.3048')
def local_contours_in_feet(plane):
    contours('map.gpkg', plane, factor=1 / FEET, z=True, code='LOCAL_CS["site",UNIT["foot",0.3048]]')
    return 'map.gpkg'


@row(TRN, 'there is no CRS', '--crs EPSG:code', '--crs none', fill={'EPSG:code': CODE})
def without_system(plane):
    dem('dem.tif', plane, code='')
    return 'dem.tif'


@row(TRN, 'there is no CRS', '--crs EPSG:code', fill={'EPSG:code': CODE}, options='--t-srs EPSG:25832')
def without_system_to_reproject(plane):
    return without_system(plane)


@row(TRN, 'no CRS to reproject from', '--crs EPSG:code', fill={'EPSG:code': CODE}, options='--t-srs EPSG:25832 --crs none')
def none_to_reproject(plane):
    return without_system(plane)


@row(TRN, 'not EPSG:25833', 'leave --crs', options='--crs EPSG:25833')
def other_system_given(plane):
    dem('dem.tif', plane)
    return 'dem.tif'


@row(TRN, 'which the file does not declare as nodata', 'gdal_translate', share=.7)
def undeclared_nodata(plane):
    cells = plane.cells()
    cells[:10, :20] = -32768
    raster("surveyor's dem.tif", cells, (X0, Y0 + SIDE), 5)
    return "surveyor's dem.tif"


@row(TRN, 'side by side, more than', 'gdal_translate', share=.7)
def undeclared_level(plane):
    plane.z0 = max(plane.z0, 1000)  # 0 m in a hillside at 0 m is ground
    cells = plane.cells()
    cells[:10, :20] = 0
    raster('dem.tif', cells, (X0, Y0 + SIDE), 5)
    return 'dem.tif'


@row(TRN, 'lower than any land', '--accept-doubts')
def below_land(plane):
    plane.z0 = -700
    dem('dem.tif', plane)
    return 'dem.tif'


@row(TRN, 'the raster has 2 bands', 'gdal_translate', options='')
def two_bands(plane):
    dem('one.tif', plane)
    gdal.Translate('dem.tif', 'one.tif', bandList=[1, 1])
    return 'dem.tif'


@row(TRN, 'the raster has 2 bands', 'gdal_translate#1', share=.7)
def band_of_known_cells(plane):
    cells = plane.cells()
    cells[:10, :20] = 0
    data = gdal.GetDriverByName('GTiff').Create('dem.tif', *cells.shape[::-1], 2, gdal.GDT_Float32)
    data.SetGeoTransform((X0, 5, 0, Y0 + SIDE, 0, -5))
    data.SetProjection(srs(CODE).ExportToWkt())
    data.GetRasterBand(1).WriteArray(cells)
    data.GetRasterBand(2).WriteArray(np.where(cells == 0, 0, 255))
    return 'dem.tif'


@row(TRN, 'colours of a picture', 'gdal_calc.py', tolerance=.1)
def terrain_rgb(plane):
    code = np.round((plane.cells() + 10000) * 10).astype(np.int64)
    data = gdal.GetDriverByName('GTiff').Create('dem.tif', *code.shape[::-1], 3, gdal.GDT_Byte)
    data.SetGeoTransform((X0, 5, 0, Y0 + SIDE, 0, -5))
    data.SetProjection(srs(CODE).ExportToWkt())
    for band, shift in ((1, 16), (2, 8), (3, 0)):
        data.GetRasterBand(band).WriteArray((code >> shift) & 255)
    return 'dem.tif'


def tiles(plane, folder):
    os.makedirs(folder, exist_ok=True)
    dem('plane.tif', plane)
    gdal.Translate(f'{folder}/west.tif', 'plane.tif', srcWin=[0, 0, 20, 40])
    gdal.Translate(f'{folder}/east.tif', 'plane.tif', srcWin=[20, 0, 20, 40])


@row(TRN, 'is a folder', 'gdalbuildvrt')
def folder_of_tiles(plane):
    tiles(plane, 'my tiles')
    return 'my tiles'


@row(TRN, 'the archive holds 2 rasters', 'unzip')
def archive_of_tiles(plane):
    tiles(plane, 'packed')
    with zipfile.ZipFile('my tiles.zip', 'w') as archive:
        for side in ('west', 'east'):
            archive.write(f'packed/{side}.tif', f'{side}.tif')
    return 'my tiles.zip'


@row(TRN, 'the archive holds 2 rasters', 'mkdir')
def tar_of_tiles(plane):
    tiles(plane, 'packed')
    with tarfile.open('tiles.tar', 'w') as archive:
        archive.add('packed')
    return 'tiles.tar'


def dem_among_others(plane, folder):
    os.makedirs(folder)
    for name, height in (('blshape', 1), ('dem', None), ('soiltype', 4)):
        cells = plane.cells() if height is None else np.full((40, 40), float(height))
        raster(f'{folder}/{name}.tif', cells, (X0, Y0 + SIDE), 5)


@row(TRN, 'is a folder', 'name one')
def folder_of_rockyfor3d(plane):
    dem_among_others(plane, 'rf3d')
    return 'rf3d'


@row(TRN, 'the archive holds 3 rasters', 'name one')
def archive_of_rockyfor3d(plane):
    dem_among_others(plane, 'rf3d')
    with zipfile.ZipFile('rf3d.zip', 'w') as archive:
        for name in sorted(os.listdir('rf3d')):
            archive.write(f'rf3d/{name}')
    return 'rf3d.zip'


@row(TRN, 'the archive holds 2 rasters', 'unzip')
def archive_of_tiles_in_folders(plane):
    tiles(plane, 'packed')
    with zipfile.ZipFile('tiles.zip', 'w') as archive:
        for side in ('west', 'east'):
            archive.write(f'packed/{side}.tif', f'{side}/dem.tif')
    return 'tiles.zip'


@row(TRN, 'reaches beyond the data', '--window', options=f'--window {X0 + 20},{X0 + 180},{Y0 + 20},{Y0 + 180}', share=.6)
def extent_of_qgis(plane):
    dem('dem.tif', plane)
    return 'dem.tif'


@row(TRN, 'does not say what system its heights are in', '--vertical-crs EPSG:code', fill={'EPSG:code': 'EPSG:5773'},
     options='--t-vertical EPSG:5773')
def unknown_system_of_heights(plane):
    dem('dem.tif', plane)
    return 'dem.tif'


@row(TRN, 'does not say what system its heights are in', '--t-srs EPSG:25833',
     options='--t-srs EPSG:25833+5773', code=CODE, rim=15)
def target_with_heights(plane):
    dem('dem.tif', plane)
    return 'dem.tif'


@row(TRN, 'has no CRS, so its heights are in no system', 'leave --vertical-crs', '--crs EPSG:code',
     fill={'EPSG:code': CODE}, options='--vertical-crs EPSG:5773 --crs none')
def heights_without_plan(plane):
    return without_system(plane)


@row(TRN, 'not in EPSG:5773', 'leave --vertical-crs', options='--vertical-crs EPSG:5773')
def other_heights_given(plane):
    dem('dem.tif', plane, code='EPSG:25832+7837')
    return 'dem.tif'


@row(TRN, 'they look like degrees', '--crs EPSG:4326 --t-srs EPSG:25832', code=CODE, rim=15)
def degrees_called_metres(plane):
    in_degrees(plane)
    gdal.Translate('called.tif', 'dem.tif', outputSRS=CODE)
    return 'called.tif'


@row(TRN, 'is it the CRS', '--crs EPSG:code', fill={'EPSG:code': CODE})
def other_system_said(plane):
    dem('dem.tif', plane, code='EPSG:31287')
    return 'dem.tif'


@row(TRN, 'with the other signs', 'gdal_translate')
def signs_of_south_and_west(plane):
    raster('my dem.tif', plane.cells(), (-(X0), -(Y0)), 5, code=CODE)
    data = gdal.Open('my dem.tif', 1)
    data.SetGeoTransform((-X0 - SIDE, 5, 0, -Y0, 0, -5))
    return 'my dem.tif'


@row(TRN, 'as kilometres they would lie in it', 'gdal_translate', plane='EPSG:2056')
def kilometres(plane):
    plane.x0, plane.y0 = 2600000, 1200000
    dem('dem.tif', plane)
    gdal.Open('dem.tif', 1).SetGeoTransform((2600, .005, 0, 1200.2, 0, -.005))
    return 'dem.tif'


@row(TRN, 'the eastings begin with the zone number 32', '--crs EPSG:4647 --t-srs EPSG:25832')
def zone_before_easting(plane):
    dem('dem.tif', plane)
    gdal.Open('dem.tif', 1).SetGeoTransform((X0 + 32e6, 5, 0, Y0 + SIDE, 0, -5))
    return 'dem.tif'


@row(TRN, 'on the other side of the equator', '--t-srs EPSG:32719', code='EPSG:32619', plane='EPSG:32619', rim=5)
def northings_below_zero(plane):
    plane.x0, plane.y0 = 500000, -1650000
    dem('dem.tif', plane)
    return 'dem.tif'


# --- surfaces of triangles -----------------------------------------------------------------------

def faces(path, plane, factor=1, header=''):
    vertices, triangles = mesh(plane)
    dxf(path, ''.join('0\n3DFACE\n8\nG\n' + ''.join(
        f'{10 + k}\n{x!r}\n{20 + k}\n{y!r}\n{30 + k}\n{z!r}\n'
        for k, (x, y, z) in enumerate((vertices[[*face, face[2]]] * factor).tolist())) for face in triangles), header)


@row(TRN, 'as millimetres it is', '--unit-m 0.001', options='--crs EPSG:25832 --cell-size-m 5')
def faces_in_millimetres(plane):
    faces('faces.dxf', plane, 1000, '9\n$INSUNITS\n70\n4\n')
    return 'faces.dxf'


@row(TRN, 'as metres it is', '--unit-m 1', options='--crs EPSG:25832 --cell-size-m 5')
def faces_said_in_millimetres(plane):
    faces('faces.dxf', plane, 1, '9\n$INSUNITS\n70\n4\n')
    return 'faces.dxf'


@row(TRN, 'linearUnit is USSurveyFoot', '--unit-m 0.3048006096', options='--crs EPSG:25832 --cell-size-m 5')
def landxml_in_feet(plane):
    vertices, triangles = mesh(plane)
    landxml('ground.xml', [('EG', vertices / SURVEY_FEET, triangles)], '<Imperial linearUnit="USSurveyFoot"/>')
    return 'ground.xml'


@row(TRN, 'expected one height in each place', '--accept-doubts', options='--crs EPSG:25832 --cell-size-m 5', tolerance=8)
def surface_that_folds_over(plane):
    vertices, triangles = mesh(plane)
    above = np.vstack([vertices, vertices[12] + [0, 0, 7]])
    landxml('ground.xml', [('G', above, triangles + [(0, 1, len(vertices))])])
    return 'ground.xml'


@row(TRN, 'has two layers at', '--accept-doubts', options='--crs EPSG:25832 --cell-size-m 5', tolerance=8)
def two_layers_of_faces(plane):
    vertices, triangles = mesh(plane)
    both = np.vstack([vertices, vertices + [0, 0, 7]])
    landxml('ground.xml', [('G', both, triangles + [tuple(i + len(vertices) for i in face) for face in triangles])])
    return 'ground.xml'


@row(TRN, 'in US survey foot', '--crs EPSG:code', '--crs none', plane='EPSG:26913',
     options='--unit-m 0.3048006096 --cell-size-m 5', fill={'EPSG:code': 'EPSG:26954'})
def landxml_of_a_state_plane(plane):
    plane.x0, plane.y0 = 950000, 520000
    vertices, triangles = mesh(plane)
    landxml('ground.xml', [('EG', vertices / SURVEY_FEET, triangles)], '<Imperial linearUnit="USSurveyFoot"/>',
            '<CoordinateSystem epsgCode="2232"/>')
    return 'ground.xml'


@row(TRN, '2 surfaces, expected one', 'ground.xml|layername=EG', options='--crs EPSG:25832 --cell-size-m 5')
def landxml_of_two(plane):
    vertices, triangles = mesh(plane)
    landxml('ground.xml', [('EG', vertices, triangles), ('FG', vertices + [0, 0, 7], triangles)])
    return 'ground.xml'


@row(TRN, 'a TIN is not reprojected', 'talus-trn', code=CODE, rim=15,
     options='--t-srs EPSG:25833 --crs EPSG:25832 --cell-size-m 5')
def surface_to_reproject(plane):
    faces('faces.dxf', plane)
    return 'faces.dxf'


# --- contours ------------------------------------------------------------------------------------

@row(TIN, 'there is no CRS', '--crs EPSG:code', '--crs none', fill={'EPSG:code': CODE})
def lines_without_system(plane):
    contours('map.gpkg', plane, code='')
    return 'map.gpkg'


@row(TIN, 'not EPSG:25833', 'leave --crs', options='--crs EPSG:25833')
def lines_of_other_system(plane):
    contours('map.gpkg', plane)
    return 'map.gpkg'


@row(TIN, 'in degrees', '--t-srs EPSG:32632', code=CODE, tolerance=.1)
def lines_in_degrees(plane):
    contours('metres.gpkg', plane)
    gdal.VectorTranslate('map.gpkg', 'metres.gpkg', dstSRS='EPSG:4326', reproject=True)
    return 'map.gpkg'


@row(TIN, 'nothing says what unit the heights are in', '--elevation-unit-m 0.304800609601', code='EPSG:26912',
     plane='EPSG:26912', options='--t-srs EPSG:26912', tolerance=.1)
def lines_in_feet(plane):
    contours('metres.gpkg', far_west(plane), height_factor=1 / SURVEY_FEET)
    gdal.VectorTranslate('map.gpkg', 'metres.gpkg', dstSRS='EPSG:3566', reproject=True)
    return 'map.gpkg'


@row(TIN, 'in feet by its name', '--elevation-unit-m 0.3048')
def field_in_feet(plane):
    contours('map.gpkg', plane, field='ELEV_FT', height_factor=1 / FEET)
    return 'map.gpkg'


@row(TIN, 'have no elevation', '--elevation-field FIELD', fill={'FIELD': 'KOTA_Q'})
def field_of_other_name(plane):
    contours('map.gpkg', plane, field='KOTA_Q')
    return 'map.gpkg'


@row(TIN, 'which stands for an unknown one', 'ogr2ogr')
def unknown_height(plane):
    rows = [(line(points), {'ELEV': z}) for z, points in plane.contours()] + [
        (line([(X0 + 20, Y0 + 30), (X0 + 80, Y0 + 30)]), {'ELEV': -9999.0})]
    shapes('map.gpkg', rows, fields=[('ELEV', ogr.OFTReal)])
    return 'map.gpkg'


@row(TIN, 'expected the same height: mixed units', '--elevation-field Z',
     '--elevation-field ELEV --elevation-unit-m 0.3048')
def z_beside_field(plane):
    rows = [(line(points, z), {'ELEV': z / FEET}) for z, points in plane.contours()]
    shapes('map.gpkg', rows, fields=[('ELEV', ogr.OFTReal)])
    return 'map.gpkg'


@row(TIN, 'there is no field', '--elevation-field FIELD', fill={'FIELD': 'ELEV'}, options='--elevation-field HEIGHT')
def field_that_is_not_there(plane):
    contours('map.gpkg', plane)
    return 'map.gpkg'


@row(TIN, 'changes its height along the line', '--elevation-field', fill={'--elevation-field': '--elevation-field KOTE'})
def z_that_slopes(plane):
    rows = [(f'LINESTRING Z ({X0} {Y0 + 2 * k * 10} {k}, {X0 + SIDE} {Y0 + 2 * k * 10} {k + 3})',
             {'KOTE': plane.z0 + 10 * k}) for k in range(11)]
    shapes('map.gpkg', rows, fields=[('KOTE', ogr.OFTReal)])
    return 'map.gpkg'


@row(TIN, 'local metres cannot be reprojected', 'leave --t-srs', options='--t-srs EPSG:25833 --crs none')
def local_to_reproject(plane):
    contours('map.gpkg', plane, code='')
    return 'map.gpkg'


def lettered(plane, code=CODE, rows=None):
    shapes('map.gpkg', rows or [(line(points), {}) for _, points in plane.contours()])
    places = [(f'POINT ({points[5][0]} {points[5][1]})', {'TEXT': str(z)}) for z, points in plane.contours()]
    shapes('labels.gpkg', places, CODE, fields=[('TEXT', ogr.OFTString)])
    if code != CODE:
        os.rename('labels.gpkg', 'there.gpkg')
        gdal.VectorTranslate('letters.gpkg', 'there.gpkg', dstSRS=code, reproject=True)


@row(TIN, 'the labels are in', 'ogr2ogr', options='--labels letters.gpkg')
def labels_elsewhere(plane):
    lettered(plane, 'EPSG:25833')
    return 'map.gpkg'


@row(TIN, 'there is no field', '--elevation-field labels=FIELD', options='--labels labels.gpkg', fill={'FIELD': 'Q'})
def labels_of_other_field(plane):
    shapes('map.gpkg', [(line(points), {}) for _, points in plane.contours()])
    places = [(f'POINT ({points[5][0]} {points[5][1]})', {'Q': str(z)}) for z, points in plane.contours()]
    shapes('labels.gpkg', places, CODE, fields=[('Q', ogr.OFTString)])
    return 'map.gpkg'


@row(TIN, 'the label says', 'leave --labels', options='--labels labels.gpkg')
def labels_beside_z(plane):
    lettered(Plane(plane.z0 + 40), CODE, [(line(points, z), {}) for z, points in plane.contours()])
    return 'map.gpkg'


@row(TIN, 'boundary crosses itself', 'ogr2ogr', options='--boundary rim.gpkg', share=.2)
def boundary_that_crosses_itself(plane):
    contours('map.gpkg', plane)
    bow = f'POLYGON (({X0} {Y0}, {X0 + 200} {Y0 + 200}, {X0 + 200} {Y0}, {X0} {Y0 + 200}, {X0} {Y0}))'
    shapes('rim.gpkg', [(bow, {})])
    return 'map.gpkg'


@row(TIN, 'as feet they would lie in it', '--unit-m 0.3048', options='--crs EPSG:31287', plane='EPSG:31287')
def drawn_in_feet_of_austria(plane):
    plane.x0, plane.y0 = 400000, 400000
    dxf('map.dxf', ''.join(polyline('C', np.asarray(p) / FEET, z / FEET) for z, p in plane.contours()))
    return 'map.dxf'


@row(TIN, 'in millimetres', '--unit-m 0.001', options='--crs EPSG:25832')
def drawn_in_millimetres(plane):
    dxf('map.dxf', ''.join(polyline('C', np.asarray(p) * 1000, z * 1000) for z, p in plane.contours()),
        '9\n$INSUNITS\n70\n4\n')
    return 'map.dxf'


@row(TIN, 'holds no lines, but 11 polygons', 'ogr2ogr', tolerance=.1)
def outlines(plane):
    rows = [(f'POLYGON (({X0} {y}, {X0 + SIDE} {y}, {X0 + SIDE} {y + 1e-3}, {X0} {y + 1e-3}, {X0} {y}))', {'ELEV': z})
            for z, ((_, y), *_) in plane.contours()]
    shapes('map.gpkg', rows, fields=[('ELEV', ogr.OFTReal)])
    return 'map.gpkg'


@row(TIN, 'no lines', '--points')
def points_alone(plane):
    shapes('map.gpkg', [(f'POINT Z ({x} {y} {z})', {}) for x, y, z in plane.points().tolist()])
    return 'map.gpkg'


@row(TIN, 'holds rows of a table', 'ogr2ogr', options='--crs EPSG:25832 --points')
def workbook(plane):
    data = ogr.GetDriverByName('XLSX').CreateDataSource('survey.xlsx')
    sheet = data.CreateLayer('Sheet 1')
    for name in ('Nr', 'Rechtswert', 'Hochwert', 'H\u00f6he'):
        sheet.CreateField(ogr.FieldDefn(name, ogr.OFTReal))
    for k, point in enumerate(plane.points().tolist()):
        feature = ogr.Feature(sheet.GetLayerDefn())
        for i, value in enumerate((k, *point)):
            feature.SetField(i, value)
        sheet.CreateFeature(feature)
    return 'survey.xlsx'


@row(TIN, 'UTF-16', 'iconv', options='--points --crs EPSG:25832')
def points_in_utf16(plane):
    write('list.csv', 'x,y,z\n'.encode('utf-16') + '\n'.join(
        f'{x:.3f},{y:.3f},{z:.3f}' for x, y, z in plane.points()).encode('utf-16-le'))
    return 'list.csv'


@row(TIN, 'are not degrees', '--crs EPSG:code', fill={'EPSG:code': CODE})
def geojson_in_metres(plane):
    contours('map.geojson', plane, code='', driver='GeoJSON')
    return 'map.geojson'


@row(TIN, 'with x and y exchanged', 'ogr2ogr')
def lines_with_exchanged_axes(plane):
    shapes('my map.gpkg', [(line(np.asarray(points)[:, ::-1]), {'ELEV': z}) for z, points in plane.contours()],
           fields=[('ELEV', ogr.OFTReal)], layer="l'altimetria")
    return 'my map.gpkg'


@row(TIN, 'as beside it', '--accept-doubts', tolerance=2000)
def impossible_height(plane):
    rows = [(line(points), {'ELEV': z + (1500 if k == 5 else 0)}) for k, (z, points) in enumerate(plane.contours())]
    shapes('map.gpkg', rows, fields=[('ELEV', ogr.OFTReal)])
    return 'map.gpkg'


@row(TIN, 'expected at most 9000 m either way', '--elevation-unit-m 0.3048')
def high_contours_in_feet(plane):
    plane.z0 = 3000
    contours('map.gpkg', plane, height_factor=1 / FEET)
    return 'map.gpkg'


@row(TIN, 'knows no shift of the datum', '--crs EPSG:code', fill={'EPSG:code': CODE}, code=CODE,
     options='--t-srs EPSG:25833')
def unknown_datum(plane):
    contours('map.gpkg', plane, code='+proj=utm +zone=32 +ellps=GRS80 +units=m')
    return 'map.gpkg'


@row(TIN, 'knows no shift of the datum', '--accept-ballpark', options='--t-srs EPSG:25833', code=CODE)
def unknown_datum_that_is_this_one(plane):
    return unknown_datum(plane)


@row(TIN, 'a surface of faces needs no contours', 'talus-trn', fill={'EPSG:code': CODE})
def faces_for_contours(plane):
    faces('my faces.dxf', plane)
    return 'my faces.dxf'


@row(TRN, 'a DEM is never reprojected silently', 'talus-trn', options='--reference other.tif')
def reference_in_other_system(plane):
    dem('dem.tif', plane)
    warp('other.tif', 'dem.tif', 'EPSG:25833')
    return 'dem.tif'


@row(TRN, 'a DEM is never reprojected silently', 'talus-trn', options='--reference other.tif')
def reference_of_a_terrain_with_prj(plane):
    dem('dem.asc', plane, driver='AAIGrid', code='')
    system = srs(CODE)
    system.MorphToESRI()
    write('dem.prj', system.ExportToWkt())
    dem('there.tif', plane)
    warp('other.tif', 'there.tif', 'EPSG:25833')
    return 'dem.asc'


@row(TRN, 'a DEM is never reprojected silently', 'talus-trn', options='--reference other.tif')
def reference_of_a_system_without_code(plane):
    plane.code = '+proj=tmerc +lat_0=0 +lon_0=9.5 +k=1 +x_0=500000 +y_0=0 +ellps=GRS80 +units=m'
    dem('dem.tif', plane)
    warp('other.tif', 'dem.tif', '+proj=utm +zone=32 +ellps=GRS80 +units=m')
    return 'dem.tif'


@row(TRN, 'nothing says what unit the heights are in', 'ogr2ogr', options='--reference-points points.gpkg', plane='EPSG:26912')
def reference_points_in_feet(plane):
    dem('dem.tif', far_west(plane))
    places = [(f'POINT Z ({x} {y} {z / SURVEY_FEET})', {}) for x, y, z in plane.points(5).tolist()[4:]]
    shapes('m.gpkg', places, 'EPSG:26912')
    gdal.VectorTranslate('points.gpkg', 'm.gpkg', dstSRS='EPSG:3566', reproject=True)
    return 'dem.tif'


@row(TRN, 'has no layers, filter and unit', 'omit --unit-m', options='--unit-m 1')
def unit_of_a_ply(plane):
    contours('map.gpkg', plane)
    accepted, said = terrain_of(TIN, 'map.gpkg', [])
    assert accepted, said
    return 't.ply'


@row(TRN, 'takes the raw bytes of a file as heights', 'gdal_translate')
def raw_bytes(plane):
    plane.cells().astype('<f4').tofile('heights.bin')
    write('dem.vrt', f'<VRTDataset rasterXSize="40" rasterYSize="40"><SRS>{CODE}</SRS><GeoTransform>{X0},5,0,{Y0 + SIDE},0,-5'
          '</GeoTransform><VRTRasterBand dataType="Float32" band="1" subClass="VRTRawRasterBand"><SourceFilename '
          'relativetoVRT="1">heights.bin</SourceFilename><ByteOrder>LSB</ByteOrder></VRTRasterBand></VRTDataset>')
    return 'dem.vrt'


@row(TRN, 'not expected', 'gdalbuildvrt', options='east.tif')
def two_tiles(plane):
    tiles(plane, '.')
    return 'west.tif'


@row(TIN, 'not expected', 'ogrmerge.py', options='north.gpkg')
def two_maps(plane):
    rows = [(line(points), {'ELEV': z}) for z, points in plane.contours()]
    for name, part in (('south', rows[:6]), ('north', rows[6:])):
        shapes(f'{name}.gpkg', part, fields=[('ELEV', ogr.OFTReal)])
    return 'south.gpkg'


@row(TIN, 'reads other files', 'ogr2ogr')
def virtual_table(plane):
    contours('map.gpkg', plane)
    base = sqlite3.connect('map.gpkg')
    base.execute('PRAGMA writable_schema = 1')
    base.execute("INSERT INTO sqlite_master VALUES ('table', 'other', 'other', 0, "
                 "'CREATE VIRTUAL TABLE other USING VirtualOGR(''x.csv'')')")
    base.commit()
    return 'map.gpkg'


# --- what a site names ---------------------------------------------------------------------------

SITES = []
BLOCK = '[blocks.b]\nshape = "box"\nsize_m = [2, 2, 1]\nposition_m = [650100, 5200150]\n'
ROCKS = BLOCK.replace('blocks', 'rockfall')
END = '[material.rock]\n[solver]\nduration_s = 0.1\n'
SOURCE = '[source]\n{keys}\n' + ''.join(
    f'[joints.{name}]\ndip_deg = {dip}\ndip_direction_deg = {direction}\nspacing_m = 8\n'
    for name, dip, direction in (('sliding', 20, 180), ('rear', 80, 0), ('lateral', 85, 90))) + '[material.rock]\n'
AREA = 'polygon = [[650060, 5200060], [650140, 5200060], [650140, 5200140], [650060, 5200140]]\n'
FLAT = 'failure_surface = "normal_depth"\ndepth_m = 5'


def site_row(tool, finding, way, truth='', fill=()):
    """A maker of the text of a site file and of the files that it names; the terrain is trn.tif. What the command of
    the hint makes takes the place of the file in the site. `truth`: what the tool says then."""
    def add(make):
        SITES.append((make, tool, finding, way, truth, dict(fill)))
        return make
    return add


BLOCKS, DDA = 'talus-blocks', 'talus-dda'


def ask(tool):
    given, kept = ['s.toml', '--trn', 'trn.tif'], ['--no-db', '--overwrite']
    code, out, err = call([BLOCKS, *given, '-o', 'b.h5', *kept])
    if code == 0 and tool == DDA:
        code, out, err = call([DDA, *given, '--blocks', 'b.h5', '-o', 'r.h5', *kept])
    if code == 0 and tool == CHECK:
        call([BLOCKS, *given, '-o', 'b.h5', '--trn-out', 'bed.tif', *kept])
        code, out, err = call([CHECK, *given, '--bed', 'bed.tif', '--blocks', 'b.h5', '--probe-s', '0', *kept])
    SAID.append(err)
    return code, out + err, err


def outline(name, wkt=None, code=CODE, driver='GPKG', factor=1.0):
    """The source as a polygon in a file: 6,400 m2."""
    shapes(name, [(wkt or square(Plane()), {})], code, driver)
    return SOURCE.format(keys=f'polygon_file = "{name}"\n' + FLAT)


@site_row(DDA, 'is not sound', 'ogr2ogr')
def ground_that_crosses_itself(_plane):
    bow = 'POLYGON ((650060 5200060, 650140 5200140, 650140 5200060, 650060 5200140, 650060 5200060))'
    shapes('bow.gpkg', [(bow, {})])
    return ('[ground.rock]\npolygon_file = "bow.gpkg"\nfriction_deg = 30\n[ground.elsewhere]\nfriction_deg = 35\n' +
            BLOCK + END)


@site_row(BLOCKS, 'are not degrees', 'ogr2ogr', 'polygon of 6,400 m2', {'EPSG:code': CODE})
def outline_as_geojson_in_metres(_plane):
    return outline('area.geojson', code='', driver='GeoJSON')


@site_row(BLOCKS, 'is it the CRS of these coordinates', 'ogr2ogr', 'polygon of 6,400 m2', {'EPSG:code': CODE})
def outline_of_other_system(_plane):
    return outline('area.gpkg', code='EPSG:31287')


@site_row(BLOCKS, 'they look like degrees', 'ogr2ogr', 'polygon of 6,400 m2')
def outline_in_degrees_called_metres(_plane):
    outline('metres.gpkg')
    gdal.VectorTranslate('degrees.gpkg', 'metres.gpkg', dstSRS='EPSG:4326', reproject=True)
    gdal.VectorTranslate('area.gpkg', 'degrees.gpkg', dstSRS=CODE, reproject=False)
    return SOURCE.format(keys='polygon_file = "area.gpkg"\n' + FLAT)


@site_row(BLOCKS, 'in millimetres', 'ogr2ogr', 'polygon of 6,400 m2')
def outline_drawn_in_millimetres(_plane):
    corners = [(650060e3, 5200060e3), (650140e3, 5200060e3), (650140e3, 5200140e3), (650060e3, 5200140e3)]
    dxf('area.dxf', polyline('A', corners + corners[:1]), '9\n$INSUNITS\n70\n4\n')
    return SOURCE.format(keys='polygon_file = "area.dxf"\n' + FLAT)


@site_row(BLOCKS, 'the thickness is -5 m', 'gdal_calc.py', '32,000 m3')
def thickness_below_zero(plane):
    raster('loss.tif', np.full((40, 40), -5.0), (X0, Y0 + SIDE), 5)
    return SOURCE.format(keys=AREA + 'failure_surface = "thickness"\nraster = "loss.tif"')


@site_row(BLOCKS, 'these are depths', 'failure_surface = "thickness"', '32,000 m3')
def depths_called_elevations(_plane):
    raster('loss.tif', np.full((40, 40), 5.0), (X0, Y0 + SIDE), 5)
    return SOURCE.format(keys=AREA + 'failure_surface = "raster"\nraster = "loss.tif"')


@site_row(BLOCKS, 'rise and fall with the ground', 'failure_surface = "raster"', '32,000 m3')
def elevations_called_depths(plane):
    raster('surface.tif', plane.cells() - 5, (X0, Y0 + SIDE), 5)
    return SOURCE.format(keys=AREA + 'failure_surface = "thickness"\nraster = "surface.tif"')


@site_row(BLOCKS, 'a raster is never reprojected silently', 'gdalwarp', '3[12],[0-9]00 m3')
def thickness_in_other_system(plane):
    raster('there.tif', np.full((40, 40), 5.0), (X0, Y0 + SIDE), 5)
    gdal.Warp('loss.tif', 'there.tif', dstSRS='EPSG:25833', dstNodata=float('nan'))
    return SOURCE.format(keys=AREA + 'failure_surface = "thickness"\nraster = "loss.tif"')


@site_row(BLOCKS, 'UTF-16', 'iconv', '40 orientations')
def joints_in_utf16(_plane):
    rows = ''.join(f'{200 + k % 7};{40 + k % 5}\n' for k in range(40))
    write('list.csv', f'Dip direction;Dip\n{rows}'.encode('utf-16'))
    measured = '[joints.measured]\nmeasured_file = "list.csv"\nspacing_m = 8\n[joints.rear]'
    return SOURCE.format(keys=AREA + FLAT).replace('[joints.rear]', measured)


@site_row(DDA, 'the raster is in', 'gdalwarp', '; 0 % of the mass moved')
def classes_in_other_system(_plane):
    raster('here.tif', np.full((40, 40), 1), (X0, Y0 + SIDE), 5, kind=gdal.GDT_Byte)
    gdal.Warp('classes.tif', 'here.tif', dstSRS='EPSG:25833', dstNodata=255)
    return grounds('classes.tif')


@site_row(DDA, 'rotated', 'gdalwarp', '; 0 % of the mass moved')
def classes_rotated(_plane):
    raster('classes.tif', np.full((10, 10), 0), None, None, place=(X0, 3, 1, Y0 + 60, 1, -3), kind=gdal.GDT_Byte)
    return grounds('classes.tif')


def grounds(name):
    """Class 0 is smooth; the block lies where it is not."""
    return (f'[terrain]\nground_raster = "{name}"\n[ground.smooth]\nfriction_deg = 5\nraster_values = [0]\n'
            '[ground.rough]\nfriction_deg = 60\nraster_values = [1]\n[ground.elsewhere]\nfriction_deg = 60\n' +
            BLOCK + END.replace('0.1', '3'))


@site_row(DDA, 'the raster is in', 'gdalwarp')
def stand_in_other_system(_plane):
    raster('here.tif', np.full((10, 10), 200.0), (X0, Y0 + SIDE), 20)
    gdal.Warp('stems.tif', 'here.tif', dstSRS='EPSG:25833', dstNodata=-1)
    return BLOCK + END + '[forest.f]\nnrtrees_raster = "stems.tif"\ndbh_mean_cm = 30\n'


@site_row(DDA, 'has other cells than nrtrees_raster', 'gdalwarp')
def stand_of_other_cells(_plane):
    raster('stems.tif', np.full((10, 10), 200.0), (X0, Y0 + SIDE), 20)
    raster('dbh.tif', np.full((20, 20), 30.0), (X0, Y0 + SIDE), 10)
    return BLOCK + END + '[forest.f]\nnrtrees_raster = "stems.tif"\ndbhmean_raster = "dbh.tif"\n'


@site_row(DDA, 'is it the CRS of these coordinates', 'gdal_translate', fill={'EPSG:code': CODE})
def stand_called_otherwise(_plane):
    raster('stems.tif', np.full((10, 10), 200.0), (X0, Y0 + SIDE), 20, code='EPSG:31287')
    return BLOCK + END + '[forest.f]\nnrtrees_raster = "stems.tif"\ndbh_mean_cm = 30\n'


@site_row(BLOCKS, 'utf-8', 'iconv')
def site_in_latin_1(_plane):
    return ('# H\u00f6rnli\n' + BLOCK + END).encode('latin-1')


@site_row(BLOCKS, '', 'iconv')
def site_in_utf16(_plane):
    return (BLOCK + END).encode('utf-16-be')


# --- keys of the site ----------------------------------------------------------------------------

# On low ground a depth of 5 m may be an elevation of 5 m as well; the tool says how deep the mass then is.
ON_HIGH_GROUND = 'depths_called_elevations',
KEYS = []


def key_row(tool, finding, section, *ways, out=(), truth='', options=()):
    """A maker of the text of a site file. A way is one of the hint: lines of keys, which go into the section in place
    of those of the same name and of the keys of `out`. Only the first words of each line, up to the value, must be in
    the hint where the value is the user's."""
    def add(make):
        KEYS.append((make, tool, finding, section, ways, out, truth, options))
        return make
    return add


CHECK = 'talus-check'
CUT = SOURCE.format(keys=AREA + FLAT)


def cut_with(**joints):
    """The cut source with keys of [joints.sliding] changed."""
    text = CUT
    for key, value in joints.items():
        text = text.replace('[joints.sliding]', f'[joints.sliding]\n{key} = {value}')
    return re.sub('(?m)^(spacing_m = 8\n)(?=\\[joints.rear)', '', text) if 'spacing_m' in joints else text


def drawn(**keys):
    """The cut source with a quantity that is drawn."""
    lines = ''.join(f'{key} = {value}\n' for key, value in keys.items())
    return CUT + f'friction_deg = 35\n[ground.slope]\nfriction_deg = 30\n[uncertainty.q]\n{lines}'


@key_row(BLOCKS, 'is not given', 'joints.sliding', 'spacing_min_m = 6\nspacing_max_m = 10')
def uniform_spacing_without_ends(_plane):
    return cut_with(spacing='"uniform"')


@key_row(BLOCKS, 'spacing_std_m of [joints.sliding] is not given', 'joints.sliding', 'spacing_std_m = 2')
def lognormal_spacing_without_scatter(_plane):
    return cut_with(spacing='"lognormal"')


@key_row(BLOCKS, 'a failure surface that daylights', 'source', 'failure_surface = "plane" then plane_dip_deg = 15\n'
         'plane_dip_direction_deg = 180\nplane_point_m = [650100, 5200060, {foot}]')
def no_set_daylights(_plane):
    return SOURCE.format(keys=AREA + 'failure_surface = "daylighting"').replace('dip_deg = 20', 'dip_deg = 5')


@key_row(BLOCKS, 'discs, expected at most', 'joints.sliding', 'persistence = 1')
def joints_of_small_discs(_plane):
    return cut_with(persistence=0.5, disc_diameter_m=0.1).replace('spacing_m = 8', 'spacing_m = 4')


@key_row(DDA, 'stands in block 0 at the start', 'forest.f', 'stems_file = "stems.gpkg|subset=fid > 1"')
def stem_in_the_source(_plane):
    shapes('stems.gpkg', [(f'POINT ({x} {y})', {'dbh_cm': 30}) for x, y in ((650100, 5200150), (650150, 5200050))],
           fields=[('dbh_cm', ogr.OFTReal)])
    return BLOCK + END + '[forest.f]\nstems_file = "stems.gpkg"\n'


@key_row(DDA, 'in no cell more than 1 %', 'forest.f', 'conifer_share = 0', out=['conif_percent_raster'])
def conifers_as_share(_plane):
    for name, value in (('stems.tif', 200.0), ('conifers.tif', .8)):
        raster(name, np.full((10, 10), value), (X0, Y0 + SIDE), 20)
    return (BLOCK + END + '[forest.f]\nnrtrees_raster = "stems.tif"\ndbh_mean_cm = 30\n'
            'conif_percent_raster = "conifers.tif"\n')


def two_blocks(apart):
    return BLOCK.replace('position_m = [650100, 5200150]',
                         f'position_m = [[650100, 5200150], [{650100 + apart}, 5200150]]') + END


@key_row(DDA, '1 pair overlaps', 'solver', 'blocks = "alone"')
def blocks_in_one_another(_plane):
    return two_blocks(1)


@key_row(DDA, '1 pair overlaps', 'solver', 'blocks = "alone"')
def blocks_that_overlap_a_little(_plane):
    return two_blocks(1.97)


@key_row(DDA, 'the same fence would stand there twice', 'fence.b', 'active = false')
def fence_twice(_plane):
    line_ = 'line = [[650050, 5200050], [650150, 5200050]]\nheight_m = 3\nactive = true\n'
    return BLOCK + END + '[fence.a]\n' + line_ + '[fence.b]\n' + line_


@key_row(BLOCKS, 'do not stand for an area', 'rockfall.b', 'frequency_per_a = 0.01', out=['frequency_per_m2_a'])
def frequency_of_an_area_of_points(_plane):
    return ROCKS + 'frequency_per_m2_a = 1e-4\n' + END


@key_row(BLOCKS, 'alone has a weight', 'variant.as_it_is', 'weight = 1')
def a_lone_weight(plane):
    return CUT + '[variant.steep]\nweight = 1\nsolver.duration_s = 20\n'


@key_row(BLOCKS, 'keys is missing', 'uncertainty.q', 'keys = ["ground.slope.friction_deg"]')
def quantity_of_no_key(_plane):
    return drawn(distribution='"uniform"', min=25, max=35)


@key_row(BLOCKS, 'distribution is missing', 'uncertainty.q', 'distribution = "uniform" then min = 25\nmax = 35')
def quantity_of_no_distribution(_plane):
    return drawn(keys='["ground.slope.friction_deg"]')


@key_row(BLOCKS, 'expected distribution = "fisher"', 'uncertainty.q',
         'distribution = "fisher"\nn_measured = 20 then uncertainty: rock_masses = 20',
         out=['min', 'max'])
def orientation_of_uniform(_plane):
    return drawn(keys='["joints.sliding.orientation"]', distribution='"uniform"', min=1, max=2).replace(
        '[joints.sliding]', '[joints.sliding]\nfisher_k = 50')


@key_row(BLOCKS, 'holds a whole number', 'uncertainty.q',
         'distribution = "discrete"\nvalues = [1, 2]', out=['min', 'max'])
def whole_number_of_uniform(_plane):
    return (ROCKS + 'rocks = 1\n' + END + '[uncertainty.q]\nkeys = ["rockfall.b.rocks"]\n'
            'distribution = "uniform"\nmin = 1\nmax = 2\n')


@key_row(BLOCKS, 'is not given, so nothing can be', 'uncertainty.q', 'apply = "set" then mean = 30')
def factor_on_nothing(_plane):
    return drawn(keys='["joints.sliding.friction_deg"]', distribution='"normal"', apply='"factor"', std=0.1)


@key_row(BLOCKS, 'on which a factor does nothing', 'uncertainty.q', 'apply = "add" then truncate = [0, 1]')
def factor_on_zero(_plane):
    return drawn(keys='["ground.slope.cohesion_pa"]', distribution='"normal"', apply='"factor"', std=0.1).replace(
        'friction_deg = 30\n', 'friction_deg = 30\ncohesion_pa = 0\n')


@key_row(BLOCKS, 'n_measured or fisher_k, one of them', 'uncertainty.q', 'n_measured = 20 then uncertainty: rock_masses = 20')
def fisher_of_no_scatter(_plane):
    return drawn(keys='["joints.sliding.orientation"]', distribution='"fisher"').replace(
        '[joints.sliding]', '[joints.sliding]\nfisher_k = 50')


@key_row(BLOCKS, 'its keys have different values', 'uncertainty.q', 'mean = 30', 'apply = "add"', 'apply = "factor"')
def mean_of_two_values(_plane):
    return drawn(keys='["ground.slope.friction_deg", "material.rock.friction_deg"]', distribution='"normal"', std=0.1)


@key_row(BLOCKS, 'lies outside of', 'uncertainty.q', 'truncate = [10, 60]')
def scatter_beyond_the_key(_plane):
    return drawn(keys='["ground.slope.friction_deg"]', distribution='"normal"', std=60)


@key_row(BLOCKS, 'since it cannot be made larger later', 'uncertainty', 'n_samples = 8')
def hypercube_of_no_size(_plane):
    return drawn(keys='["ground.slope.friction_deg"]', distribution='"uniform"', min=25, max=35) + (
        '[uncertainty]\nsampling = "hypercube"\n')


@key_row(CHECK, 'points that slide from the source ask for', 'solver', 'duration_s = #')
def short_run(_plane):
    return CUT + '[ground.slope]\nfriction_deg = 20\n[solver]\nduration_s = 1\n'


@key_row(CHECK, 'the face is steep', 'source', 'failure_surface = "daylighting"', out=['depth_m'])
def depth_along_the_normal_of_a_steep_face(plane):
    plane.z = lambda x, y: plane.z0 + 2 * (y - plane.y0) + 0 * x
    return CUT.replace('dip_deg = 20', 'dip_deg = 50') + '[ground.slope]\nfriction_deg = 20\n'


# --- the test ------------------------------------------------------------------------------------

SAID = []


def obey(entry, way):
    make, tool, finding, _, options, fill, then, comparison, tolerance, share, code = entry
    plane = Plane(-50, code)
    source, options = make(plane), list(options)
    accepted, said = terrain_of(tool, source, options, SAID)
    assert not accepted, f'accepted, expected: {finding}: {said}'
    assert finding in said, f'expected: {finding}; it says: {said}'
    source, options = follow(way, hint_in(said), source, options, fill, then, SAID)
    tool = TRN if way == 'talus-trn' else tool
    accepted, said = terrain_of(tool, source, options, SAID)
    if not accepted:  # the second step: its first command, else its first option
        hint = hint_in(said)
        assert hint, f'after {way} no hint: {said}'
        second = commands_in(hint)[0].split()[0] if commands_in(hint) else re.search(r'--[a-z-]+', hint).group()
        source, options = follow(second, hint, source, options, fill, then, SAID)
        accepted, said = terrain_of(tool, source, options, SAID)
    assert accepted, f'refused after two steps: {said}'
    error, known = errors_of(plane, **comparison)
    assert error <= tolerance and known >= share, f'{error:.3f} m off the truth, {100 * known:.1f} % known: {said}'
    return error


LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
OPTION = r'(?<![\w-])--[a-z][a-z-]+ '
KEY = r'\b[a-z_]{3,} = ["\[\da-z]|\b[a-z_]{3,} = $|\badd [a-z_]+_m\b'
DECLARED = re.compile(r'^void declare\(.*?^}|^\s*//.*?$', re.M | re.S)
# What no input of this table leads to, and why.
NOT_OBEYED = {
    'leave --inputs out': 'obeyed in talus-import.test_whole_site',
    'write it anew: make': 'obeyed in talus-import.test_whole_site',
    'fetch it first and name the copy': 'needs the network',
    'pdal translate': 'Debian 12 has no package',
    'fetch it with projsync': 'needs the network',
    'write EPSG:code, for example': 'of an option that is misspelt',
    '--doubts places.gpkg writes': 'shows, and changes nothing',
    'from true north give [joints] convergence_deg': 'turns joints: tests/unit/import/test_crs_place.cpp',
    '--hold-out': 'of options that do not go together',
    '--like': 'of options that do not go together',
    '--cell-size-m is': 'of options that do not go together',
    'omit --cell-size-m (of a site': 'of a terrain that is made: talus-trn/test_averaging.sh',
    '--unit-m is for faces': 'of options that do not go together',
    'with talus-tin --t-srs ': 'the contours are not there',
    'TERRAIN.tif --t-vertical': 'needs a grid of PROJ',
    'slbl_curvature_m = ': 'says, and asks for nothing',
    'with frames = false': 'help of a key',
    'e.g. keys = ': 'help of a key',
    'sections of the site that it lacks': 'help of a key',
    "name = '": 'a filter of a layer',
    'value = [': 'a value of --set',
    'key = value': 'how TOML is written',
    'protect = "NAME"': 'of results of runs',
    'does not belong to distribution': 'the hint is to take a key out',
    'frequency_per_a = ': 'a file that is written',
    ' of its foot': 'the foot of a mass that was cut',
    'daylight = "': 'of a mass that was cut: talus-check/test_look.sh',
}


def hints_in_sources(source_dir):
    """Literals that hold a command of the shell, or, where inputs are read, an option: (place, text)."""
    for folder, pattern in (('libcore', rf'\b{SHELL} '), ('libcore/io', OPTION), ('libcore/import', OPTION),
                            ('libcore/terrain', OPTION), ('tools/tin', OPTION), ('tools/trn', OPTION),
                            ('tools', rf'\b{SHELL} '), ('libcore/blocks', KEY), ('libcore/import', KEY),
                            ('libcore/setup', KEY), ('libcore/site', KEY), ('libcore/terrain', KEY),
                            ('libcore/record', KEY), ('tools/blocks', KEY)):
        for path in sorted((source_dir / folder).rglob('*.cpp')):
            if path.name.startswith('gone_'):
                continue
            source = DECLARED.sub('', path.read_text(encoding='utf-8'))
            for match in LITERALS.finditer(source):
                words = ''.join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match[0])).replace('\\"', '"').replace('\\n', '\n')
                if re.search(pattern, words):
                    yield f'{path.relative_to(source_dir)}', words.strip('\n')


def obey_in_site(entry, z0):
    """As obey(), of a site: the name of the file changes in the site."""
    make, tool, finding, way, truth, fill = entry
    dem('dem.tif', Plane(z0))
    call([TRN, 'dem.tif', '-o', 'trn.tif', '--no-db'])
    text = make(Plane(z0))
    head = f'[site]\nname = "t"\ncrs = "{CODE}"\n'
    write('s.toml', head + text if isinstance(text, str) else
          head.encode('utf-16-be' if b'\0' in text else 'ascii') + text)
    code, said, err = ask(tool)
    assert code == 1 and finding in err, f'expected: {finding}; it says: {said}'
    hint = hint_in(err)
    if ' = ' in way:  # a key of the site
        assert way in hint, f'no "{way}" in the hint: {hint}'
        with open('s.toml', encoding='utf-8') as file:
            site = file.read()
        write('s.toml', re.sub(f'(?m)^{way.split()[0]} = .*$', way, site))
        code, said, _ = ask(tool)
        assert code == 0 and re.search(truth, said), f'with {way}, expected: {truth}; it says: {said}'
        return
    command = next((words for words in commands_in(hint) if words.split()[0] == way), None)
    assert command, f'no {way} in the hint: {hint}'
    for what, instead in fill.items():
        command = command.replace(what, instead)
    status, _, trouble = call(command)
    assert status == 0, f'the command of the hint fails: {command}: {trouble}'
    made = made_by(command)
    if made.endswith('.toml'):
        os.replace(made, 's.toml')
    else:
        with open('s.toml', encoding='utf-8') as file:
            site = file.read()
        named = [name for name in re.findall(r'"([^"]+[.][a-z]+)"', site) if name in shlex.split(command)]
        assert len(named) == 1, f'{command} names {named}'
        write('s.toml', site.replace(named[0], made))
    code, said, _ = ask(tool)
    assert code == 0 and re.search(truth, said), f'after {command}, expected: {truth}; it says: {said}'


def with_keys(site, section, lines, out):
    """The text of the site with these lines of keys in the section, which is made if there is none."""
    names = [line_.split(' = ')[0] for line_ in lines.split('\n')] + list(out)
    parts = re.split(r'(?m)^(?=\[)', site)
    header = f'[{section}]\n'
    parts += [header] if not any(part.startswith(header) for part in parts) else []
    return ''.join(part if not part.startswith(header) else
                   header + lines + '\n' + re.sub(f'(?m)^({"|".join(names)}) = .*\n', '', part[len(header):])
                   for part in parts)


def obey_key(entry, way, z0):
    """As obey(), of keys that a hint names. The second step follows "then"."""
    make, tool, finding, section, _, out, truth, options = entry
    plane = Plane(z0)
    site = f'[site]\nname = "t"\ncrs = "{CODE}"\n' + make(plane)
    dem('dem.tif', plane)
    call([TRN, 'dem.tif', '-o', 'trn.tif', '--no-db'])
    write('s.toml', site)
    code, said, err = ask(tool)
    assert finding in err, f'expected: {finding}; it says: {said}'
    for step in way.format(foot=z0 + 30).split(' then '):
        hint = hint_in(err[:err.index(finding)] + err[err.index(finding):].split('warning:')[0]) if code == 0 else hint_in(err)
        other, _, step = step.rpartition(': ')
        for line_ in step.split('\n'):
            assert line_.split(' = ')[0] in hint, f'no "{line_.split(" = ")[0]}" in the hint: {hint}'
        if '#' in step:
            step = re.search(step.replace('#', r'[-\d.]+'), hint)[0]
        site = with_keys(site, other or section, step, out)
        write('s.toml', site)
        code, said, err = ask(tool)
    assert code == 0 and finding not in err and re.search(truth, said), f'after {way}: {said}'


def in_folder(name, function):
    """Whether it ends well in a folder of its own."""
    folder = re.sub('[^A-Za-z0-9]+', '_', name)
    shutil.rmtree(folder, ignore_errors=True)
    os.mkdir(folder)
    os.chdir(folder)
    try:
        error = function()
        print(f'{name}: {"obeyed" if error is None else f"{error:.3f} m off"}')
    except Exception as why:
        print(f'FAILED: {name}: {type(why).__name__} {why}')
        return False
    finally:
        os.chdir('..')
    return True


def main(source_dir, wanted):
    failed = 0
    for entry in TABLE:
        name = entry[0].__name__
        for way in entry[3]:
            if not wanted or name in wanted:
                failed += not in_folder(f'{name}, {way}', lambda e=entry, w=way: obey(e, w))
    for z0 in (1000.0, -50.0):  # 0 m lies in the hillside
        for entry in SITES:
            if entry[0].__name__ in ON_HIGH_GROUND and z0 < 0:
                continue
            if not wanted or entry[0].__name__ in wanted:
                failed += not in_folder(f'{entry[0].__name__}, {z0:g} m', lambda e=entry, z=z0: obey_in_site(e, z))
        for entry in KEYS:
            for way in entry[4]:
                if not wanted or entry[0].__name__ in wanted:
                    failed += not in_folder(f'{entry[0].__name__}, {way}, {z0:g} m'.replace('\n', ', '),
                                            lambda e=entry, w=way, z=z0: obey_key(e, w, z))
    if not wanted:
        said = '\n'.join(SAID)
        for place, words in dict.fromkeys(hints_in_sources(pathlib.Path(source_dir))):
            if words not in said and not any(part in words for part in NOT_OBEYED):
                failed += 1
                print(f'FAILED: {place}: no row leads to the hint "{words}"')
    return failed


if __name__ == '__main__':
    sys.exit(1 if main(sys.argv[1], sys.argv[2:]) else 0)
