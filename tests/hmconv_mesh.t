#!/bin/sh
# hmconv: meshes for other programs, byte by byte for a small one, and as other programs read them.
. "${0%/*}/tap.sh"

# convert FORMAT …: the mesh written as that goes to got, what was said to err
convert() {
    hmconv -t "$@" mesh.hm >got 2>err
}

cat >mesh.hm <<'END'
#hm 1 mesh text
#name main
#string inflow 0 3
#string outflow 4 1 0
#string wall_north 2 3
#crs UTM 32N WGS84
#data
v 545000.5 5972000.123456789 1.25 0 0
v 545010 5972000 0.30000000000000004 0 0
v 545010 5972010 -2e-7 0 0
v 545000 5972010 2 0 0
v 545020 5972000 12345.678 0 0
q 0 1 2 3 0
t 1 4 2 7
#end 7
END

convert geo
cat >want <<'END'
T1 main
T2
T3
SI 1
GE 1 1 6 2 8 3 10 4 7 8
GE 2 2 9 5 11 3 8 0 0 7
GNN 1 545000.5 5972000.123456789 1.25
GNN 2 545010 5972000 0.30000000000000004
GNN 3 545010 5972010 -2e-7
GNN 4 545000 5972010 2
GNN 5 545020 5972000 12345.678
GNN 6 545005.25 5972000.061728395 0.775
GNN 7 545000.25 5972005.061728395 1.625
GNN 8 545010 5972005 0.14999990000000002
GNN 9 545015 5972000 6172.9890000000005
GNN 10 545005 5972010 0.9999999
GNN 11 545015 5972005 6172.8389999
GC 1 1 4 -1
GC 2 5 2 1 -1
GC 3 3 4 -1
END
same "RMA2, with mid-side nodes" want got
cat >want <<'END'
hmconv: geo has no place for the crs: "UTM 32N WGS84" dropped
hmconv: geo has no material 0: 1 elements get the number behind the largest
END
same "what geo lacks is said" want err

convert 2d
cat >want <<'END'
FP         1      545000.5000000     5972000.1234568           1.2500000
FP         2      545010.0000000     5972000.0000000           0.3000000
FP         3      545010.0000000     5972010.0000000          -0.0000002
FP         4      545000.0000000     5972010.0000000           2.0000000
FP         5      545020.0000000     5972000.0000000       12345.6780000
AR         1         1         2         1         0         0
AR         2         4         1         1         0         0
AR         3         2         3         1         2         0
AR         4         2         5         2         0         0
AR         5         3         4         1         0         0
AR         6         5         3         2         0         0
FE         1         8         8         0
FE         2         7         7         0
END
same "Kalypso" want got
cat >want <<'END'
hmconv: 2d has no place for the crs: "UTM 32N WGS84" dropped
hmconv: 2d has no node strings: 3 dropped
hmconv: 2d has no material 0: 1 elements get the number behind the largest
hmconv: 2d has seven decimals
END
same "what 2d lacks is said" want err

convert gr3
cat >want <<'END'
main
2 5
1 545000.5 5972000.123456789 -1.25
2 545010 5972000 -0.30000000000000004
3 545010 5972010 2e-7
4 545000 5972010 -2
5 545020 5972000 -12345.678
1 4 1 2 3 4
2 3 2 5 3
2 = Number of open boundaries
5 = Total number of open boundary nodes
3 0
1
2
5
2 0
4
1
1 = Number of land boundaries
3 = Total number of land boundary nodes
3 0
5
3
4
END
same "SCHISM" want got
cat >want <<'END'
hmconv: gr3 has no place for the crs: "UTM 32N WGS84" dropped
hmconv: gr3 has no materials: those of 1 elements dropped
END
same "what gr3 lacks is said" want err

convert fort14
cat >want <<'END'
main
3 5
1 545000.5 5972000.123456789 -1.25
2 545010 5972000 -0.30000000000000004
3 545010 5972010 2e-7
4 545000 5972010 -2
5 545020 5972000 -12345.678
1 3 1 2 3
2 3 1 3 4
3 3 2 5 3
2 = Number of open boundaries
5 = Total number of open boundary nodes
3 0
1
2
5
2 0
4
1
1 = Number of land boundaries
3 = Total number of land boundary nodes
3 0
5
3
4
END
same "ADCIRC" want got
cat >want <<'END'
hmconv: fort14 has no place for the crs: "UTM 32N WGS84" dropped
hmconv: 1 quadrilateral split into triangles
hmconv: fort14 has no materials: those of 1 elements dropped
END
same "what fort14 lacks is said" want err

convert cli
cat >want <<'END'
5 4 4 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0 1 1 # outflow
5 4 4 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0 2 2 # outflow
5 4 4 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0 5 3 # outflow
2 2 2 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0 3 4 # wall_north
4 5 5 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0 4 5 # inflow
END
same "conditions for TELEMAC" want got
cat >want <<'END'
hmconv: 1 quadrilateral split into triangles
END
same "what cli lacks is said" want err

convert vtk
cat >want <<'END'
# vtk DataFile Version 3.0
main
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
 545000.5 5972000.123456789 1.25
 545010 5972000 0.30000000000000004
 545010 5972010 -2e-7
 545000 5972010 2
 545020 5972000 12345.678
CELLS 2 9
4 0 1 2 3
3 1 4 2
CELL_TYPES 2
9
5
CELL_DATA 2
SCALARS region int 1
LOOKUP_TABLE default
0
7
END
same "VTK" want got
cat >want <<'END'
hmconv: vtk has no place for the crs: "UTM 32N WGS84" dropped
hmconv: vtk has no node strings: 3 dropped
END
same "what vtk lacks is said" want err

convert vtu
cat >want <<'END'
<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<Points>
<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
 545000.5 5972000.123456789 1.25
 545010 5972000 0.30000000000000004
 545010 5972010 -2e-7
 545000 5972010 2
 545020 5972000 12345.678
</DataArray>
</Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">
 0 1 2 3
 1 4 2
</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">
4
7
</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">
9
5
</DataArray>
</Cells>
<CellData Scalars="region">
<DataArray type="Int32" Name="region" format="ascii">
0
7
</DataArray>
</CellData>
</Piece>
</UnstructuredGrid>
</VTKFile>
END
same "VTK in XML" want got
cat >want <<'END'
hmconv: vtu has no place for the crs: "UTM 32N WGS84" dropped
hmconv: vtu has no node strings: 3 dropped
END
same "what vtu lacks is said" want err

convert msh
cat >want <<'END'
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "inflow"
1 2 "outflow"
1 3 "wall_north"
2 8 "region 0"
$EndPhysicalNames
$Nodes
5
1 545000.5 5972000.123456789 1.25
2 545010 5972000 0.30000000000000004
3 545010 5972010 -2e-7
4 545000 5972010 2
5 545020 5972000 12345.678
$EndNodes
$Elements
6
1 1 2 1 1 1 4
2 1 2 2 2 5 2
3 1 2 2 2 2 1
4 1 2 3 3 3 4
5 3 2 8 8 1 2 3 4
6 2 2 7 7 2 5 3
$EndElements
END
same "Gmsh" want got
cat >want <<'END'
hmconv: msh has no place for the crs: "UTM 32N WGS84" dropped
END
same "what msh lacks is said" want err

convert ply
cat >want <<'END'
ply
format ascii 1.0
element vertex 5
property double x
property double y
property double z
element face 2
property list uchar int vertex_indices
property int region
end_header
545000.5 5972000.123456789 1.25
545010 5972000 0.30000000000000004
545010 5972010 -2e-7
545000 5972010 2
545020 5972000 12345.678
4 0 1 2 3 0
3 1 4 2 7
END
same "PLY" want got
cat >want <<'END'
hmconv: ply has no place for the crs: "UTM 32N WGS84" dropped
hmconv: ply has no node strings: 3 dropped
END
same "what ply lacks is said" want err

convert tsh
cat >want <<'END'
5 1 # <# of verts> <# of vert attributes>, next lines <vertex #> <x> <y> [attributes] ...Triangulation Vertices...
0 545000.5 5972000.123456789 1.25
1 545010 5972000 0.30000000000000004
2 545010 5972010 -2e-7
3 545000 5972010 2
4 545020 5972000 12345.678
# attribute column titles ...Triangulation Vertex Titles...
elevation
3 # <# of triangles>, next lines <triangle #> [<vertex #>] [<neigbouring triangle #>] [attribute of region] ...Triangulation Triangles...
0 0 1 2 2 1 -1 0
1 0 2 3 -1 -1 0 0
2 1 4 2 -1 0 -1 7
5 # <# of segments>, next lines <segment #> <vertex #>  <vertex #> [boundary tag] ...Triangulation Segments...
0 0 1 outflow
1 1 4 outflow
2 4 2 exterior
3 2 3 wall_north
4 3 0 inflow
0 0 # <# of verts> <# of vert attributes>, next lines <vertex #> <x> <y> [attributes] ...Mesh Vertices...
0 # <# of segments>, next lines <segment #> <vertex #>  <vertex #> [boundary tag] ...Mesh Segments...
0 # <# of holes>, next lines <Hole #> <x> <y> ...Mesh Holes...
0 # <# of regions>, next lines <Region #> <x> <y> <tag>...Mesh Regions...
0 # <# of regions>, next lines <Region #> [Max Area] ...Mesh Regions...
#geo reference
32
0.0
0.0
END
same "ANUGA" want got
cat >want <<'END'
hmconv: 1 quadrilateral split into triangles
END
same "what tsh lacks is said" want err

sed 's/^#crs.*/#crs TM lon=9 lat=0 scale=1 x=0 y=0 WGS84/' mesh.hm | hmconv -t tsh >got 2>err
ok "which is no other crs" grep -q 'tsh has no place for the crs: "TM lon=9' err
printf '#hm 1 grid text\n#size 2 2\n#origin 0 0\n#step 1 1\n#crs UTM 32N WGS84\n#units ft ft m\n#data\n0 0 1\n1 0 3\n0 1 1\n1 1 6\n#end\n' | hmconv -t asc >got 2>err
ok "an ESRI grid: the crs and the units" sh -c 'grep -q "dropped (-t prj writes it)" err && grep -q "asc has no units: coordinates stay in ft" err'
convert medit
cat >want <<'END'
MeshVersionFormatted 2
Dimension 2
Vertices
5
545000.5 5972000.123456789 0
545010 5972000 0
545010 5972010 0
545000 5972010 0
545020 5972000 0
Edges
5
1 2 2
2 5 2
5 3 0
3 4 3
4 1 1
Triangles
1
 2 5 3 7
Quadrilaterals
1
 1 2 3 4 0
End
END
same "Medit" want got
cat >want <<'END'
hmconv: medit has no place for the crs: "UTM 32N WGS84" dropped
hmconv: medit has no heights: dropped
END
same "what medit lacks is said" want err

convert srhgeom
cat >want <<'END'
SRHGEOM 30
Name "main"

GridUnit "Meters"
Elem 1 1 2 3 4
Elem 2 2 5 3
Node 1 545000.5 5972000.123456789 1.25
Node 2 545010 5972000 0.30000000000000004
Node 3 545010 5972010 -2e-7
Node 4 545000 5972010 2
Node 5 545020 5972000 12345.678
NodeString 1 1 4
NodeString 2 5 2 1
NodeString 3 3 4
END
same "SRH-2D" want got
cat >want <<'END'
hmconv: srhgeom has no place for the crs: "UTM 32N WGS84" dropped
hmconv: srhgeom has no materials: those of 1 elements dropped
END
same "what srhgeom lacks is said" want err

# --- binary: by readers of others ---
python=
for p in /usr/bin/python3 python3; do
    [ -n "$python" ] || { "$p" -c 'import netCDF4, numpy' 2>/dev/null && python=$p; }
done
convert ugrid
ok "UGRID: node strings are dropped aloud" grep -q 'ugrid has no node strings: 3 dropped' err
ok "UGRID: classic NetCDF" sh -c '[ "$(head -c 4 got | od -An -tx1)" = " 43 44 46 01" ]'
if [ -n "$python" ]; then
    cat >check.py <<'END'
import netCDF4, numpy as np
d = netCDF4.Dataset('got')
d.set_auto_mask(False)
v = d.variables
assert v['mesh2d'].cf_role == 'mesh_topology' and v['mesh2d'].topology_dimension == 2
x, y = (v[n] for n in v['mesh2d'].node_coordinates.split())
assert x.standard_name == 'projection_x_coordinate' and x.units == 'm'
assert list(x[:]) == [545000.5, 545010, 545010, 545000, 545020]
assert list(y[:]) == [5972000.123456789, 5972000, 5972010, 5972010, 5972000]
z = v['mesh2d_node_z']
assert z.standard_name == 'altitude' and z.location == 'node' and z.mesh == 'mesh2d'
assert list(z[:]) == [1.25, 0.30000000000000004, -2e-7, 2, 12345.678]
f = v[v['mesh2d'].face_node_connectivity]
assert f.start_index == 1 and f._FillValue == -1
assert f[:].tolist() == [[1, 2, 3, 4], [2, 5, 3, -1]]
e = v[v['mesh2d'].edge_node_connectivity]
assert sorted(tuple(sorted(p)) for p in e[:].tolist()) == [(1, 2), (1, 4), (2, 3), (2, 5), (3, 4), (3, 5)]
assert v['mesh2d_face_region'][:].tolist() == [0, 7]
assert v[z.grid_mapping].epsg == 32632
END
    ok "UGRID as netCDF4 reads it" "$python" check.py
else
    skip "python3-netcdf4 is not there"
fi
convert slf
ok "Selafin: what is split and dropped is said" sh -c \
    'grep -q "1 quadrilateral split" err && grep -q "no node strings: 3" err && grep -q "no materials" err'
if [ -n "$python" ]; then
    cat >check.py <<'END'
import struct, numpy as np
b = open('got', 'rb').read()
records = []
while b:
    n, = struct.unpack('>i', b[:4])
    assert struct.unpack('>i', b[4 + n:8 + n]) == (n,)
    records.append(b[4:4 + n])
    b = b[8 + n:]
title, nvar, name, par, size, ikle, rank, x, y, time, z = records
assert title == b'main'.ljust(72) + b'SERAFIND' and name == b'BOTTOM'.ljust(16) + b'M'.ljust(16)
assert struct.unpack('>2i', nvar) == (1, 0) and struct.unpack('>10i', par) == (1,) + 9 * (0,)
assert struct.unpack('>4i', size) == (3, 5, 3, 1)
assert np.frombuffer(ikle, '>i4').tolist() == [1, 2, 3, 1, 3, 4, 2, 5, 3]
assert np.frombuffer(rank, '>i4').tolist() == [1, 2, 4, 5, 3]
assert np.frombuffer(x, '>f8').tolist() == [545000.5, 545010, 545010, 545000, 545020]
assert np.frombuffer(y, '>f8').tolist() == [5972000.123456789, 5972000, 5972010, 5972010, 5972000]
assert np.frombuffer(z, '>f8').tolist() == [1.25, 0.30000000000000004, -2e-7, 2, 12345.678]
assert struct.unpack('>d', time) == (0,)
END
    ok "Selafin, record by record" "$python" check.py
fi
if [ -n "$python" ] && "$python" -c 'import meshio' 2>/dev/null; then
    cat >check.py <<'END'
import meshio, numpy as np
for name, regions in (('vtk', 'region'), ('vtu', 'region'), ('ply', 'region'), ('gmsh', 'gmsh:physical'), ('medit', 'medit:ref')):
    m = meshio.read('got.' + name, name)
    assert m.points[:, :2].tolist() == [[545000.5, 5972000.123456789], [545010, 5972000], [545010, 5972010], [545000, 5972010], [545020, 5972000]], name
    assert name == 'medit' or m.points[:, 2].tolist() == [1.25, 0.30000000000000004, -2e-7, 2, 12345.678], name
    cells = {c.type: (c.data.tolist(), np.ravel(d).tolist()) for c, d in zip(m.cells, m.cell_data[regions])}
    assert cells['quad'] == ([[0, 1, 2, 3]], [8 if name == 'gmsh' else 0]) and cells['triangle'] == ([[1, 4, 2]], [7]), name
END
    for f in vtk vtu ply msh medit; do
        convert $f
        mv got got.$f
    done
    mv got.msh got.gmsh
    ok "vtk, vtu, ply, msh and medit as meshio reads them" "$python" check.py
else
    skip "python3-meshio is not there"
fi
if command -v gmsh >/dev/null; then
    convert msh
    cp got mesh.msh
    ok "Gmsh opens it and finds no fault" sh -c 'gmsh mesh.msh -0 -check >out 2>&1 && ! grep -q -i error out'
else
    skip "gmsh is not there"
fi

# --- on the way: split, origin, depths ---
hmconv -s --origin 545000,5972000 mesh.hm >local.hm
ok "split and from a local origin" sh -c 'grep -qx "t 0 1 2 0" local.hm && grep -qx "t 0 2 3 0" local.hm &&
    grep -qx "v 10 0 0.30000000000000004 0 0" local.hm && grep -q "^#crs UTM 32N WGS84, from 545000,5972000" local.hm'
convert gr3 --datum 10
ok "depths below a datum" grep -qx '1 545000.5 5972000.123456789 8.75' got
hmconv -s mesh.hm | sed -n 's/^v //p' | cut -d ' ' -f 1-2 >want
hmconv --datum 10 got >back.hm
sed -n 's/^v //p' back.hm | cut -d ' ' -f 1-2 >seen
same "and back" want seen
ok "heights again" sh -c 'grep -q "^v 545000.5 5972000.123456789 1.25 0 0" back.hm && grep -q "^#prog hmconv [0-9.]* --datum 10$" back.hm'
hmconv -t gr3 --datum 10 got >again
same "and depths once more" got again
sed 's/545010 5972010 -2e-7/545004 5972006 0/' mesh.hm >concave.hm
ok "a concave quadrilateral is split inside" sh -c 'hmconv -s concave.hm | grep -qx "t 0 1 2 0"'
awk 'BEGIN { # an island, all round open: both loops whole
    print "#hm 1 mesh text\n#data"
    for (i = 0; i < 16; i++) print "v", i % 4, int(i / 4), 0, 0, 0
    for (j = 0; j < 3; j++) for (i = 0; i < 3; i++) { k = 4 * j + i
        if (i != 1 || j != 1) print "q", k, k + 1, k + 5, k + 4, 0 } print "#end" }' >ring.hm
hmconv -t gr3 ring.hm | sed -n '/Number of land/,$p' | tr '\n' ' ' >got
printf '2 = Number of land boundaries 17 = Total number of land boundary nodes 13 0 1 2 3 4 8 12 16 15 14 13 9 5 1 4 1 6 10 11 7 ' >want
same "an island is type 1" want got
sed 's/^#data/#string open 0 1 2\n&/' ring.hm | hmconv -t gr3 | sed -n '/open boundaries/,$p' | tr '\n' ' ' >got
printf '1 = Number of open boundaries 3 = Total number of open boundary nodes 3 0 1 2 3 2 = Number of land boundaries 15 = Total number of land boundary nodes 11 0 3 4 8 12 16 15 14 13 9 5 1 4 1 6 10 11 7 ' >want
same "land goes from the end of what is open to its beginning" want got

# --- what is refused ---
sed 's/0.30000000000000004/nan/' mesh.hm >nan.hm
for f in ugrid geo 2d gr3 slf vtk msh ply tsh srhgeom; do
    must_fail "$f: a node without height" 2 "no height at 545010 5972000" hmconv -t $f nan.hm
done
must_fail "a full disk" 2 "space|full" sh -c "hmconv -t ugrid mesh.hm >/dev/full"
must_fail "a string that is none" 2 "inflow: expected numbers of nodes" \
    sh -c "sed 's/inflow 0 3/inflow 0 99/' mesh.hm | hmconv -t gr3"
must_fail "a line too long for RMA2" 2 "80 columns" sh -c \
    "sed 's/^v 3 3 0/v -1.2345678901234567e-100 -1.2345678901234567e-100 -1.2345678901234567e-100/' ring.hm | hmconv -t geo"
must_fail "an origin that is none" 2 "two numbers" hmconv --origin 5 mesh.hm
must_fail "a mesh with an edge used twice" 2 "" sh -c \
    'sed "s/^t 1 4 2 7/t 0 1 2 7/" mesh.hm | hmconv -t gr3'
done_testing
