#!/usr/bin/env python3
"""Reads the files of talus-export of run.h5, and compares it with the run.

  read_back.py RUN.h5 TRN.tif TIME_S NAME

NAME.glb by the rules of glTF 2.0 and by VTK, NAME.ply, NAME.obj and NAME.vtp by VTK, NAME.xmf with
its data by XML and HDF5. Needs python3-h5py, python3-vtk9 and python3-gdal.
"""
import json
import struct
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np
import vtk
from osgeo import gdal
from vtk.util.numpy_support import vtk_to_numpy

run_file, trn_file, time_s, name = sys.argv[1], sys.argv[2], float(sys.argv[3]), sys.argv[4]
run = h5py.File(run_file)
origin = run.attrs["origin_m"]
frame = int(np.argmin(np.abs(run["frames/time_s"][:] - time_s)))
begin = run["blocks/vertex_begin"][:]
n_blocks = len(begin) - 1


def turned(attitude, points):
    """Body to local axes, by the quaternion w x y z: v + 2 u x (u x v + w v)."""
    w, *u = attitude / np.linalg.norm(attitude)
    return points + 2 * np.cross(u, np.cross(u, points) + w * points)


def vertices_of(frame, block):
    points = run["blocks/vertices_m"][begin[block]:begin[block + 1]]
    return run["frames/position_m"][frame, block] + turned(run["frames/attitude"][frame, block].astype(float), points)


blocks = [vertices_of(frame, b) for b in range(n_blocks)]
volumes = run["blocks/volume_m3"][:]
raster = gdal.Open(trn_file)
elevations, (left, cell, _, top, _, _) = raster.ReadAsArray(), raster.GetGeoTransform()
n_rows, n_cols = elevations.shape
rows, cols = np.mgrid[:n_rows, :n_cols]
nodes = np.column_stack([(left + (cols + 0.5) * cell).ravel(), (top - (rows + 0.5) * cell).ravel(), elevations.ravel()])
n_nodes, n_ground = len(nodes), 2 * (n_rows - 1) * (n_cols - 1)


def check(claim, what):
    if not claim:
        sys.exit(f"FAILED: {what}")


def is_near(found, expected, within, what):
    check(np.shape(found) == np.shape(expected), f"{what}: {np.shape(found)}, expected {np.shape(expected)}")
    error = np.abs(np.asarray(found) - expected).max()
    check(error <= within, f"{what}: off by {error}")


def volume_of(points, triangles):
    """Of a closed surface whose triangles are counter-clockwise seen from outside."""
    a, b, c = (points[triangles[:, k]] - points.mean(axis=0) for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def in_order(points):
    """Of a plan of whole metres: by y, then x."""
    return points[np.lexsort(np.rint(points[:, :2]).T)]


# --- GLB, as the specification says ---------------------------------------------------------------
with open(name + ".glb", "rb") as file:
    glb = file.read()
magic, version, length = struct.unpack_from("<4sII", glb)
check((magic, version, length) == (b"glTF", 2, len(glb)), "header of the GLB")
chunks, at = [], 12
while at < len(glb):
    size, kind = struct.unpack_from("<I4s", glb, at)
    check(size % 4 == 0, "a chunk that is not aligned to four bytes")
    chunks.append((kind, glb[at + 8:at + 8 + size]))
    at += 8 + size
check([kind for kind, _ in chunks] == [b"JSON", b"BIN\0"], "chunks of the GLB")
gltf, binary = json.loads(chunks[0][1]), chunks[1][1]
check(gltf["asset"]["version"] == "2.0", "version of the asset")
check(0 <= len(binary) - gltf["buffers"][0]["byteLength"] < 4, "length of the buffer")
for view in gltf["bufferViews"]:
    check(view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= len(binary), "a view's place")


def array_of(accessor):
    kind, columns = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]], {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
    view = gltf["bufferViews"][accessor["bufferView"]]
    check(view.get("byteStride", 4 * columns) == 4 * columns, "a stride that is not the size of an element")
    check(accessor["byteOffset"] + accessor["count"] * 4 * columns <= view["byteLength"], "an accessor's end")
    values = np.frombuffer(binary, kind, accessor["count"] * columns, view["byteOffset"] + accessor["byteOffset"])
    return values.reshape(-1, columns)


check(len(gltf["nodes"]) == n_blocks + 1 and gltf["scenes"][0]["nodes"] == list(range(n_blocks + 1)), "nodes")
is_near(gltf["scenes"][0]["extras"]["origin_m"], origin, 0, "origin of the GLB")
for b, node in enumerate(gltf["nodes"]):
    primitive = gltf["meshes"][node["mesh"]]["primitives"][0]
    positions = gltf["accessors"][primitive["attributes"]["POSITION"]]
    points = array_of(positions).astype(float)
    corners = array_of(gltf["accessors"][primitive["indices"]]).reshape(-1, 3)
    check(corners.max() < len(points), "a corner that is not a vertex")
    is_near(positions["min"], points.min(axis=0), 0, "smallest coordinates")
    is_near(positions["max"], points.max(axis=0), 0, "largest coordinates")
    x, y, z, w = node["rotation"]
    check(abs(x * x + y * y + z * z + w * w - 1) < 1e-6, "a rotation that is not of length 1")
    placed = turned(np.array([w, x, y, z]), points) + node["translation"]
    east_north_up = np.column_stack([placed[:, 0], -placed[:, 2], placed[:, 1]])  # y is up in the file
    if b == n_blocks:
        check(node["name"] == "ground" and len(points) == n_nodes and len(corners) == n_ground, "ground of the GLB")
        is_near(in_order(east_north_up + origin), in_order(nodes), 1e-3, "ground of the GLB")
        continue
    check(node["name"] == f"block_{b:06d}", f"name {node['name']}")
    is_near(east_north_up, blocks[b], 1e-3, f"block {b} of the GLB")
    is_near(volume_of(east_north_up, corners), volumes[b], 1e-4 * volumes[b], f"volume of block {b} in the GLB")

# --- all four by VTK ------------------------------------------------------------------------------
expected = np.concatenate(blocks) + origin


def read(reader, ending):
    failed = []
    reader.AddObserver("ErrorEvent", lambda *_: failed.append(ending))
    reader.SetFileName(name + ending)
    reader.Update()
    check(not failed, f"VTK cannot read {name}{ending}")
    return reader.GetOutput()


def numbers(data, array):
    return vtk_to_numpy(data.GetCellData().GetArray(array))


vtp = read(vtk.vtkXMLPolyDataReader(), ".vtp")
points = vtk_to_numpy(vtp.GetPoints().GetData())
triangles = vtk_to_numpy(vtp.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
is_near(points[:len(expected)], expected, 1e-9, "points of the VTP")
check(vtp.GetNumberOfPoints() == len(expected) + n_nodes, "number of points of the VTP")
check((numbers(vtp, "block") == -1).sum() == n_ground, "triangles of the ground in the VTP")
for b in range(n_blocks):
    of_block = triangles[numbers(vtp, "block") == b]
    is_near(volume_of(points, of_block), volumes[b], 1e-9 * volumes[b], f"volume of block {b} in the VTP")
    speed = np.linalg.norm(run["frames/velocity_m_s"][frame, b])
    is_near(numbers(vtp, "speed_m_s")[numbers(vtp, "block") == b], np.full(len(of_block), speed), 1e-5, "speed")
is_near(vtp.GetFieldData().GetArray("TimeValue").GetTuple(0), [run["frames/time_s"][frame]], 1e-12, "time of the VTP")

ply = read(vtk.vtkPLYReader(), ".ply")  # VTK takes the coordinates in single precision
check(ply.GetNumberOfCells() == vtp.GetNumberOfCells(), "triangles of the PLY")
is_near(vtk_to_numpy(ply.GetPoints().GetData()), points, 0.5, "points of the PLY")
obj = read(vtk.vtkOBJReader(), ".obj")
check(obj.GetNumberOfPoints() == vtp.GetNumberOfPoints(), "points of the OBJ")
glb = read(vtk.vtkGLTFReader(), ".glb")
check(glb.GetNumberOfCells() == vtp.GetNumberOfCells(), "triangles of the GLB by VTK")
bounds = np.zeros(6)
glb.GetBounds(bounds)
heights = points[:, 2] - origin[2]
is_near(bounds[2:4], [heights.min(), heights.max()], 1e-2, "heights of the GLB by VTK, y up")

# --- XDMF -----------------------------------------------------------------------------------------
grids = ElementTree.parse(name + ".xmf").findall("./Domain/Grid/Grid")
check(len(grids) == len(run["frames/time_s"]), "frames of the XDMF")
for k, grid in enumerate(grids):
    is_near(float(grid.find("Time").get("Value")), run["frames/time_s"][k], 1e-12, "a time of the XDMF")
    file, path = grid.find("Geometry/DataItem").text.split(":")
    is_near(h5py.File(file)[path][:], np.concatenate([vertices_of(k, b) for b in range(n_blocks)]), 1e-3,
            f"points of frame {k} of the XDMF")
