#!/usr/bin/env python3
"""Sites for forecast.py: a slope of the Serles, and sites drawn at random.

The ground is one of the elevation models of ../shared/data/dem, the source a rectangle on a slope of 36 to 58 degrees;
joints, friction and the kind of failure surface are drawn. Needs python3-gdal.
"""
import math
import os
import random

from osgeo import gdal, osr

gdal.UseExceptions()
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
dems = ['serles_10m', 'gschnitz_gar_full_5m', 'lechtal_kot_full_5m', 'arlberg_wog_full_5m']

site_text = '''[site]
name = "{name}"
crs = "{crs}"
[terrain]
dem = "{dem}"
[source]
polygon = {polygon}
{surface}
[joints.sliding]
dip_deg = {sliding[0]}
dip_direction_deg = {sliding[1]}
spacing_m = {sliding[2]}
[joints.rear]
dip_deg = {rear[0]}
dip_direction_deg = {rear[1]}
spacing_m = {rear[2]}
[joints.lateral]
dip_deg = {lateral[0]}
dip_direction_deg = {lateral[1]}
spacing_m = {lateral[2]}
[material.rock]
density_kg_m3 = 2600
friction_deg = 30
[ground.slope]
friction_deg = {friction}
[solver]
duration_s = {duration}
'''


def write(out, **values):
    folder = os.path.join(out, values['name'])
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, 'site.toml'), 'w') as f:
        f.write(site_text.format(**values))
    with open(os.path.join(folder, 'Makefile'), 'w') as f:
        f.write(f'include {root}/pipelines/site.mk\n')
    return folder


def slope_at(z, cell, row, col, half):
    """Dip and dip direction [degrees] of the mean plane between four nodes."""
    dz_dx = (z[row][col + half] - z[row][col - half]) / (2 * half * cell)
    dz_dy = (z[row - half][col] - z[row + half][col]) / (2 * half * cell)
    return (math.degrees(math.atan(math.hypot(dz_dx, dz_dy))), math.degrees(math.atan2(-dz_dx, -dz_dy)) % 360)


def rectangle(x, y, aspect, along, across):
    a = math.radians(aspect)
    down, side = (math.sin(a), math.cos(a)), (math.cos(a), -math.sin(a))
    return [[round(x + s * along / 2 * down[0] + t * across / 2 * side[0], 1),
             round(y + s * along / 2 * down[1] + t * across / 2 * side[1], 1)]
            for s, t in ((1, 1), (1, -1), (-1, -1), (-1, 1))]


def drawn_site(draw, name, out):
    dem = os.path.join(root, '..', 'shared', 'data', 'dem', draw.choice(dems) + '.tif')
    raster = gdal.Open(dem)
    gt, z = raster.GetGeoTransform(), raster.ReadAsArray().astype(float)
    code = osr.SpatialReference(wkt=raster.GetProjection()).GetAuthorityCode(None)
    while True:
        row, col = draw.randrange(30, z.shape[0] - 30), draw.randrange(30, z.shape[1] - 30)
        dip, aspect = slope_at(z, gt[1], row, col, max(1, round(20 / gt[1])))
        if 36 < dip < 58:
            break
    polygon = rectangle(gt[0] + (col + .5) * gt[1], gt[3] + (row + .5) * gt[5], aspect, draw.uniform(35, 55),
                        draw.uniform(40, 60))
    surface = draw.choice([
        f'failure_surface = "normal_depth"\ndepth_m = {draw.uniform(4, 8):.1f}', 'failure_surface = "daylighting"',
        f'failure_surface = "normal_depth"\ndepth_m = {draw.uniform(4, 8):.1f}\ndaylight = "sliding"',
        'failure_surface = "slbl"\nslbl_scenario = "inter"'])
    spread = lambda azimuth, by: round((azimuth + draw.uniform(-by, by)) % 360)
    spacing = lambda: round(draw.uniform(9, 14), 1)
    return write(out, name=name, crs=f'EPSG:{code}', dem=dem, polygon=polygon, surface=surface,
          sliding=(round(dip - draw.uniform(3, 14)), spread(aspect, 15), spacing()),
          rear=(round(draw.uniform(74, 88)), spread(aspect + 180, 20), spacing()),
          lateral=(round(draw.uniform(78, 88)), spread(aspect + 90, 20), spacing()),
          friction=round(draw.uniform(24, 34)), duration=20)


def drawn(out, seed):
    """Folders without end, each of a site drawn anew: the same ones for the same seed."""
    draw = random.Random(seed)
    k = 0
    while True:
        yield drawn_site(draw, f'drawn_{seed}_{k}', out)
        k += 1


def serles(out):
    """The north face of the Serles: 60 x 50 m, a hollow of 8 m, three sets 8 m apart."""
    x, y = 79120, 222100
    return write(out, name='serles', crs='EPSG:31254',
                 dem=os.path.join(root, '..', 'shared', 'data', 'dem', 'serles_10m.tif'),
                 polygon=[[x - 30, y - 25], [x + 30, y - 25], [x + 30, y + 25], [x - 30, y + 25]],
                 surface='failure_surface = "normal_depth"\ndepth_m = 8', sliding=(30, 340, 8), rear=(68, 355, 8),
                 lateral=(82, 78, 8), friction=28, duration=40)
