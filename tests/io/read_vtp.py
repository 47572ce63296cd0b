#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads with VTK's own reader the files that tests/unit/io/vtp_test.cpp wrote, and checks what is in them.

usage: read_vtp.py FOLDER        exit status 0: all is as written
"""
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def read(path):
    complaints = []
    reader = vtkXMLPolyDataReader()
    reader.AddObserver(vtkCommand.ErrorEvent, lambda *event: complaints.append(path))
    reader.SetFileName(path)
    reader.Update()
    assert not complaints, f"VTK complains about {path}"
    return reader.GetOutput()


def check_mesh(path):
    mesh = read(path)
    assert mesh.GetNumberOfPoints() > 60000 and mesh.GetNumberOfPolys() > 120000
    assert mesh.GetPoints().GetData().GetDataTypeAsString() == "double"
    radius = mesh.GetPointData().GetArray('radius <m> & "more"')
    first, vector = mesh.GetCellData().GetArray("first"), mesh.GetCellData().GetArray("vector")
    assert vector.GetNumberOfComponents() == 3
    for i in range(mesh.GetNumberOfPoints()):
        assert math.isclose(radius.GetValue(i), math.hypot(*mesh.GetPoint(i)), rel_tol=1e-15)
    area = 0.0
    for t in range(mesh.GetNumberOfPolys()):
        cell = mesh.GetCell(t)
        corners = [cell.GetPointId(k) for k in range(3)]
        assert cell.GetNumberOfPoints() == 3 and first.GetValue(t) == corners[0]
        assert vector.GetTuple3(t) == (2.0 * corners[1], 4.0 * corners[1], 8.0 * corners[1])
        area += cell.ComputeArea()
    assert math.isclose(area, math.pi * (24e-3**2 - 20e-3**2), rel_tol=1e-5), area


def check_spheres(path):
    spheres = read(path)
    assert spheres.GetNumberOfPoints() == spheres.GetNumberOfVerts() == 2
    assert spheres.GetPoint(1) == (4.0, 5.0, 6.0)
    data = spheres.GetPointData()
    assert [data.GetArray("radius").GetValue(i) for i in (0, 1)] == [0.5, 0.25]
    assert [data.GetArray("id").GetValue(i) for i in (0, 1)] == [7.0, 8.0]


def main(folder):
    check_mesh(os.path.join(folder, "mesh.vtp"))
    check_spheres(os.path.join(folder, "spheres.vtp"))
    assert read(os.path.join(folder, "empty.vtp")).GetNumberOfCells() == 0
    series = ElementTree.parse(os.path.join(folder, "series.pvd")).getroot()
    assert series.get("type") == "Collection"
    for entry in series.iter("DataSet"):
        assert os.path.exists(os.path.join(folder, entry.get("file"))) and float(entry.get("timestep")) >= 0.0


if __name__ == "__main__":
    main(sys.argv[1])
