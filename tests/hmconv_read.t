#!/bin/sh
# hmconv reads meshes of other programs: what it wrote itself, what they wrote, and what is broken.
. "${0%/*}/tap.sh"

cat >mesh.hm <<'END'
#hm 1 mesh text
#name main
#string inflow 0 3
#string outflow 4 1 0
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
hmconv -s mesh.hm | grep -v '^#prog' >triangles.hm
without() { # KEYS FILE: without these lines of the header
    grep -Ev "^#($1)" "$2"
}

# --- there and back: all that the format holds, to the last bit ---
for f in ugrid msh ply vtk gr3 2d slf fort14; do
    hmconv -t $f mesh.hm >mesh.$f 2>err
    hmconv mesh.$f >back.$f
done
without 'name|string' mesh.hm >want
same "UGRID and back: coordinates, elements, regions, crs" want back.ugrid
without 'name|crs' mesh.hm >want
same "msh and back: with the strings, and region 0" want back.msh
without 'name|string|crs' mesh.hm >want
same "PLY and back" want back.ply
without 'string|crs' mesh.hm >want
same "VTK and back" want back.vtk
without 'string|crs' triangles.hm | sed '/^t/s/ 7$/ 0/' >want
same "Selafin and back" want back.slf
{ echo '#hm 1 mesh text'; echo '#name main'; echo '#string open1 0 1 4'; echo '#string open2 3 0'
  sed -n '/^#data/,$p' mesh.hm | sed '/^t/s/ 7$/ 0/'; } >want
same "gr3 and back: depths, open boundaries" want back.gr3
{ sed -n 1,4p want; sed -n '/^#data/,$p' triangles.hm | sed '/^t/s/ 7$/ 0/'; } >want.14
same "fort.14 and back" want.14 back.fort14
cat >want <<'END'
#hm 1 mesh text
#data
v 545000.5 5972000.1234568 1.25 0 0
v 545010 5972000 0.3 0 0
v 545010 5972010 -2e-7 0 0
v 545000 5972010 2 0 0
v 545020 5972000 12345.678 0 0
q 0 1 2 3 8
t 2 1 4 7
#end 7
END
same "Kalypso and back: seven decimals" want back.2d
for f in ugrid msh ply vtk; do
    hmconv -t $f back.$f >again 2>err
    hmconv again >twice
    same "$f once more" back.$f twice
done
ok "the other tools do not know them" sh -c '! stitch mesh.ply >/dev/null 2>&1'
ok "--info of them" sh -c 'hmconv -i mesh.ugrid | grep -q "1 triangles, 1 quadrilaterals"'
hmconv - <mesh.msh >piped
same "from a pipe" back.msh piped

# --- as others write them ---
cat >gaps.gr3 <<'END'
a mesh with gaps
2 4  ! elements, nodes
10 0 0 -1.5
7 10. 0 2 behind it
30 1.e1 10 0
5 0 10 0
1 3 10 7 30
2 3 10 30 5
END
sed 's/ ! elements, nodes//' gaps.gr3 >plain.gr3
cat >want <<'END'
#hm 1 mesh text
#data
v 0 0 1.5 0 0
v 10 0 -2 0 0
v 10 10 0 0 0
v 0 10 0 0 0
t 0 1 2 0
t 0 2 3 0
#end 6
END
hmconv plain.gr3 >got
same "gr3: ids with gaps, no boundaries, a remark" want got
cat >other.msh <<'END'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Comments
nothing
$EndComments
$Nodes
3
5 0 0 0
2 1 0 0
9 0 1 0
$EndNodes
$Elements
3
1 15 2 0 1 5
2 1 2 4 1 5 2
3 2 3 6 1 0 5 2 9
$EndElements
END
printf '#hm 1 mesh text\n#string 4 0 1\n#data\nv 0 0 0 0 0\nv 1 0 0 0 0\nv 0 1 0 0 0\nt 0 1 2 6\n#end 4\n' >want
hmconv other.msh >got
same "msh: ids with gaps, points, lines without a name" want got
cat >other.ply <<'END'
ply
format ascii 1.0
comment others have colours
element vertex 3
property float z
property float x
property uchar red
property float y
element face 1
property list uchar int vertex_index
END
printf 'end_header\n7 0 255 0\n8 1 255 0\n9 0 255 1\n3 0 1 2\n' >>other.ply
printf '#hm 1 mesh text\n#data\nv 0 0 7 0 0\nv 1 0 8 0 0\nv 0 1 9 0 0\nt 0 1 2 0\n#end 4\n' >want
hmconv other.ply >got
same "PLY: other properties, in another order" want got
cat >middle.2d <<'END'
FP         1           0.0000000           0.0000000           0.0000000
FP         2           1.0000000           0.0000000           1.0000000
FP         3           0.0000000           1.0000000           2.0000000
FP         4           0.5000000           0.0000000           0.5000000
AR         1         1         2         1         0         4
AR         2         3         2         0         1         0
AR         3         1         3         0         1         0
FE         1         3         3         0
END
printf '#hm 1 mesh text\n#data\nv 0 0 0 0 0\nv 1 0 1 0 0\nv 0 1 2 0 0\nt 0 1 2 3\n#end 4\n' >want
hmconv middle.2d >got
same "Kalypso: mid-side nodes, arcs either way" want got
python=
for p in /usr/bin/python3 python3; do
    [ -n "$python" ] || { "$p" -c 'import netCDF4, numpy' 2>/dev/null && python=$p; }
done
if [ -n "$python" ]; then
    cat >make.py <<'END'
import netCDF4, numpy as np, struct
d = netCDF4.Dataset('other.nc', 'w', format='NETCDF3_64BIT_OFFSET')
for n, k in (('n', 4), ('f', 2), ('m', 4)):
    d.createDimension(n, k)
v = d.createVariable('faces', 'i4', ('f', 'm'), fill_value=-999)
v.cf_role = 'face_node_connectivity'
v[:] = np.ma.masked_equal([[0, 1, 2, -999], [0, 2, 3, -999]], -999)
t = d.createVariable('Mesh2', 'i4')
t.cf_role, t.topology_dimension, t.node_coordinates, t.face_node_connectivity = 'mesh_topology', np.int32(2), 'ex why', 'faces'
for n, x in (('why', [0, 0, 10, 10]), ('ex', [0, 10, 10, 0])):
    d.createVariable(n, 'f4', ('n',))[:] = x
z = d.createVariable('bed', 'f8', ('n',))
z.standard_name, z.location = 'altitude', 'node'
z[:] = [1.5, -2, 0, 0]
d.close()
def rec(b): return struct.pack('>i', len(b)) + b + struct.pack('>i', len(b))
with open('other.slf', 'wb') as f:
    f.write(rec(b'a title of words'.ljust(72) + b'SERAFIN ') + rec(struct.pack('>2i', 2, 0)))
    f.write(rec(b'VELOCITY U'.ljust(16) + b'M/S'.ljust(16)) + rec(b'BOTTOM'.ljust(16) + b'M'.ljust(16)))
    f.write(rec(struct.pack('>10i', 1, 0, 545000, 5972000, 0, 0, 0, 0, 0, 1)) + rec(struct.pack('>6i', 2020, 1, 1, 0, 0, 0)))
    f.write(rec(struct.pack('>4i', 2, 4, 3, 1)) + rec(struct.pack('>6i', 1, 2, 3, 1, 3, 4)) + rec(struct.pack('>4i', 1, 2, 3, 4)))
    f.write(rec(struct.pack('>4f', 0, 10, 10, 0)) + rec(struct.pack('>4f', 0, 0, 10, 10)))
    for t in (0., 60.):
        f.write(rec(struct.pack('>f', t)) + rec(struct.pack('>4f', 9, 9, 9, 9)) + rec(struct.pack('>4f', 1.5 + t, -2, 0, 0)))
END
    "$python" make.py
    hmconv plain.gr3 >want
    hmconv other.nc >got
    same "UGRID: counts from 0, single precision, other names, CDF-2" want got
    sed 's/^v \([0-9]*\) \([0-9]*\)/echo v $((545000+\1)) $((5972000+\2))/e' want >moved
    hmconv other.slf >got
    same "Selafin: single precision, origin, date, two variables, two frames" moved got
else
    skip "python3-netcdf4 is not there"
fi
if command -v gmsh >/dev/null; then
    printf 'Point(1)={0,0,0};Point(2)={4,0,0};Point(3)={4,3,0};Point(4)={0,3,0};Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};
Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};Physical Curve("inflow")={4};Physical Surface("bed",5)={1};Mesh.MeshSizeMax=1;\n' >box.geo
    gmsh box.geo -2 -format msh22 -o box.msh >gmsh.log 2>&1
    hmconv box.msh >box.hm
    ok "what Gmsh writes" sh -c 'grep -q "^#string inflow " box.hm && ! grep "^t" box.hm | grep -qv " 5$"'
    gmsh box.geo -2 -format msh4 -o box4.msh >gmsh.log 2>&1
    must_fail "a newer version of msh, with the way out" 2 "version 2.*msh22" hmconv box4.msh
    hmconv -t msh mesh.hm >own.msh
    gmsh own.msh -0 -format msh22 -o through.msh >gmsh.log 2>&1
    ok "Gmsh writes again all that it was given" sh -c 'hmconv -i through.msh | grep -q "1 triangles, 1 quadrilaterals"'
else
    skip "gmsh is not there"
fi

# --- broken files ---
must_fail "gr3: a word for a number" 2 'plain.gr3:4: expected a number, got "high"' \
    sh -c "sed -i 's/^7 10. 0 2/7 10. 0 high/' plain.gr3; hmconv plain.gr3"
cp gaps.gr3 t; sed 's/ ! elements, nodes//' t >plain.gr3
must_fail "gr3: two nodes of one id" 2 'two nodes have the id 7' sh -c "sed 's/^10 0/7 0/' plain.gr3 | hmconv"
must_fail "gr3: a node that is not there" 2 'not there' sh -c "sed 's/^2 3 10/2 3 11/' plain.gr3 | hmconv"
must_fail "gr3: fewer nodes than it says" 2 '.' sh -c "sed 's/^2 4/2 400000000/' plain.gr3 | hmconv"
must_fail "gr3: five corners" 2 'three nor four' sh -c "sed 's/^2 3 10/2 5 10/' plain.gr3 | hmconv"
must_fail "msh: binary" 2 'as text' sh -c "sed 's/^2.2 0/2.2 1/' other.msh | hmconv"
must_fail "msh: a tetrahedron" 2 'neither point' sh -c "sed 's/^3 2 3/3 4 3/' other.msh | hmconv"
must_fail "msh: nodes twice" 2 'a second time' sh -c "sed '/EndNodes/r other.msh' other.msh | hmconv"
must_fail "ply: binary" 2 'as text' sh -c "sed 's/ascii/binary_little_endian/' other.ply | hmconv"
must_fail "ply: a face of five" 2 'three nor four' sh -c "sed 's/^3 0 1 2/5 0 1 2 0 1/' other.ply | hmconv"
must_fail "vtk: binary" 2 'as text' sh -c "sed 's/ASCII/BINARY/' mesh.vtk | hmconv"
must_fail "vtk: a hexahedron" 2 'neither triangle' sh -c "sed 's/^9$/12/' mesh.vtk | hmconv"
must_fail "2d: arcs that do not go round" 2 'go round' sh -c "sed 's/^AR         2         3/AR         2         1/' middle.2d | hmconv"
must_fail "2d: one dimension" 2 'one dimension' sh -c "sed 's/2         0         1         0/2         1         1         0/' middle.2d | hmconv"
printf '\211HDF\r\n\032\n and so on' >four.nc
must_fail "NetCDF 4, with the way out" 2 'nccopy -k classic' hmconv four.nc
{ printf 'P\0\0\0'; tail -c +5 mesh.slf; } >little.slf
must_fail "Selafin the other way round" 2 'little.slf: little-endian' hmconv little.slf
printf 'CDF\001\0\0\0\0\012\0\0\0\001\0\0\0' >little.nc
must_fail "and NetCDF" 2 'little.nc: ' hmconv little.nc
# two thousand million of what there is one: the file ends, nothing is made room for
huge=2000000000
printf 'huge\n%s %s\n1 0 0 1\n2 1 0 1\n' 1 $huge >huge.gr3
sed "s/^3\$/$huge/" other.msh >huge.msh
sed "s/vertex 3/vertex $huge/" other.ply >huge.ply
sed "s/^POINTS 5/POINTS $huge/" mesh.vtk >huge.vtk
limit="ulimit -v 100000;" # which the sanitizers cannot run under
sh -c "$limit hmconv --version" >/dev/null 2>&1 || limit=
for f in gr3 msh ply vtk; do
    must_fail "$f: a huge count" 2 "huge.$f:[0-9]*: " sh -c "$limit hmconv huge.$f"
done
for f in ugrid slf msh ply vtk gr3 2d; do
    size=$(wc -c <mesh.$f)
    for part in 1 2 3 4 5 6 7 8 9 10 11; do
        head -c $((size * part / 12)) mesh.$f >cut
        hmconv cut >got 2>err
        status=$?
        # gr3 may end behind its elements, a word may be cut; but never is there a crash
        case $status in
        2) [ ! -s got ] || echo "$part: something written" ;;
        0) case $f in gr3 | vtk | 2d) ;; *) echo "$part: taken for whole" ;; esac ;;
        *) echo "$part: status $status" ;;
        esac
    done >bad
    [ ! -s bad ]
    report $? "$f cut off: an error, and nothing written"
    sed 's/^/# /' bad
done
done_testing
