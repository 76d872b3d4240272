#!/bin/sh
# Meshes and grids of the chain as the programs of their users have them: QGIS (MDAL), FreeFem++, meshio,
# GDAL. tests/deps oracles installs these; what is not there is skipped.
. "${0%/*}/tap.sh"

"$TESTS/small_chain" . >chain.log 2>&1 || { sed 's/^/# /' chain.log; report 1 "small chain"; }
sed 's/^#data/#crs UTM 32N WGS84\n&/' hybrid.hm >triangles.hm
cat >quads.hm <<'END'
#hm 1 mesh text
#name main
#string inflow 0 3
#crs UTM 32N WGS84
#data
v 545000.5 5972000.123456789 1.25 0 0
v 545010 5972000 0.30000000000000004 0 0
v 545010 5972010 -2e-7 0 0
v 545000 5972010 2 0 0
v 545020 5972000 12345.678 0 0
q 0 1 2 3 3
t 1 4 2 7
#end 7
END
# With a module of that name, the Python of the packages, not another that is first on PATH.
python_with() {
    for p in /usr/bin/python3 python3; do
        "$p" -c "import $1" 2>/dev/null && { echo "$p"; return; }
    done
}

# --- QGIS: every vertex, every face, heights, materials, crs ---
python=$(python_with qgis.core)
if [ -n "$python" ]; then
    # as the stream has it: `v x y z` with nine digits behind the point, `f a b c`, `r region`
    cat >see.py <<'END'
import os, sys
os.environ['QT_QPA_PLATFORM'] = 'offscreen'
from qgis.core import *
QgsApplication.setPrefixPath('/usr', True)
app = QgsApplication([], False)
app.initQgis()
for path in sys.argv[1:]:
    layer = QgsMeshLayer(path, 'mesh', 'mdal')
    out = open(path + '.seen', 'w')
    data, mesh = layer.dataProvider(), QgsMesh()
    if layer.isValid():
        data.populateMesh(mesh)
        values = {}
        for g in range(data.datasetGroupCount()):
            meta = data.datasetGroupMetadata(g)
            n = data.faceCount() if meta.dataType() == QgsMeshDatasetGroupMetadata.DataOnFaces else data.vertexCount()
            block = data.datasetValues(QgsMeshDatasetIndex(g, 0), 0, n)
            values[meta.name().split()[0].lower()] = [block.value(i).scalar() for i in range(n)]
        z = values.get('bed', values.get('bottom'))
        for i in range(data.vertexCount()):
            print('v %.7f %.7f %.9f' % (mesh.vertex(i).x(), mesh.vertex(i).y(), z[i]), file=out)
        for i in range(data.faceCount()):
            print('f', *mesh.face(i), file=out)
        for name in 'material', 'region':
            for v in values.get(name, []):
                print('r %d' % v, file=out)
        print('crs', data.crs().authid(), file=out)
    out.close()
out = None
os._exit(0)
END
    # What QGIS should see of a stream, materials being `none`, `number` or, without 0, `behind`.
    wanted() { # FILE MATERIALS CRS
        awk -v materials="$2" '
            $1 == "v" { printf "v %.7f %.7f %.9f\n", $2, $3, $4 }
            $1 == "t" { print "f", $2, $3, $4; r[++n] = $5 }
            $1 == "q" { print "f", $2, $3, $4, $5; r[++n] = $6 }
            END { for (i = 1; i <= n; i++) if (r[i] > most) most = r[i]
                  if (materials != "none") for (i = 1; i <= n; i++) print "r", materials == "behind" && r[i] == 0 ? most + 1 : r[i] }' "$1"
        echo "crs $3"
    }
    for mesh in triangles quads; do
        for f in 2dm ugrid slf ply; do
            hmconv -t $f -o $mesh.$f $mesh.hm 2>err
        done
    done
    QT_LOGGING_RULES='*=false' timeout 120 "$python" see.py triangles.2dm triangles.ugrid triangles.slf triangles.ply \
        quads.2dm quads.ugrid quads.slf quads.ply >qgis.log 2>&1
    for mesh in triangles quads; do
        hmconv -s $mesh.hm >split.hm
        wanted $mesh.hm behind '' >want
        same "$mesh: 2dm as QGIS sees it" want $mesh.2dm.seen
        wanted $mesh.hm number EPSG:32632 >want
        same "$mesh: UGRID" want $mesh.ugrid.seen
        wanted $mesh.hm number '' >want
        same "$mesh: PLY" want $mesh.ply.seen
        wanted split.hm none '' >want
        same "$mesh: Selafin" want $mesh.slf.seen
    done
else
    skip "the Python of QGIS is not there (python3-qgis, qgis-providers)"
fi

# --- FreeFem++: water in the mesh ---
if command -v FreeFem++ >/dev/null; then
    hmconv -t medit hybrid.hm >m.mesh 2>err
    hmconv -t node hybrid.hm >m.node
    cat >water.edp <<'END'
// Shallow water, closed all round: a hump of water, ten steps; how the volume changes.
mesh Th = readmesh("m.mesh");
fespace Vh(Th, P1);
Vh bed, h, hold, u = 0, v = 0, uold, vold, eta, psi, a, b;
{
    ifstream f("m.node");
    int n, dim, attributes, markers, id;
    real xn, yn, zn;
    f >> n >> dim >> attributes >> markers;
    assert(n == Th.nv);
    for (int i = 0; i < n; i++) {
        f >> id >> xn >> yn >> zn >> markers;
        assert(abs(xn - Th(i).x) + abs(yn - Th(i).y) < 1e-6);
        bed[][i] = zn;
    }
}
real g = 9.81, dt = 2, level = bed[].max + 2;
real xm = int2d(Th)(x) / Th.area, ym = int2d(Th)(y) / Th.area;
eta = level + 0.5 * exp(-((x - xm)^2 + (y - ym)^2) / 1000);
hold = eta - bed;
real volume = int2d(Th)(hold), worst = 0, before = eta[].max - level;
for (int step = 0; step < 10; step++) {
    uold = u; vold = v;
    // depth of the old level in the flux, which is integrated by parts: with psi = 1 the volume stays
    solve wave([h, u, v], [psi, a, b]) =
        int2d(Th)(h * psi / dt - hold * (u * dx(psi) + v * dy(psi)))
      + int2d(Th)((u * a + v * b) / dt + g * (dx(h) * a + dy(h) * b))
      - int2d(Th)(hold * psi / dt)
      - int2d(Th)((convect([uold, vold], -dt, uold) * a + convect([uold, vold], -dt, vold) * b) / dt
                  - g * (dx(bed) * a + dy(bed) * b));
    hold = h;
    worst = max(worst, abs(int2d(Th)(h) - volume) / volume);
}
eta = h + bed;
cout.precision(15);
cout << "water " << Th.area << " " << Th.nt << " " << Th.nbe << " " << worst << " " << before << " "
     << eta[].max - level << " " << eta[].min - level << endl;
END
    timeout 120 FreeFem++ -nw -v 0 water.edp >freefem.log 2>&1
    read -r word area triangles edges worst before after least <<END
$(grep '^water' freefem.log)
END
    [ "$word" = water ]
    report $? "FreeFem++ reads the mesh and its heights"
    set -- $(awk '$1 == "v" { x[n + 0] = $2; y[n++] = $3 }
        $1 == "t" { t++; sum += ((x[$3] - x[$2]) * (y[$4] - y[$2]) - (x[$4] - x[$2]) * (y[$3] - y[$2])) / 2 }
        END { printf "%.6f %d\n", sum, t }' hybrid.hm)
    true_that "its area" "($1 - $area)^2 < 1e-6 * 1e-6 * $1 * $1"
    true_that "its triangles and boundary" "$triangles == $2 && $edges > 100"
    true_that "the volume of the water stays" "$worst < 1e-10"
    true_that "while the hump runs out" "$before > 0.4 && $after < 0.2 * $before && $least > -0.2 * $before"
else
    skip "FreeFem++ is not there (freefem++)"
fi

# --- meshio: what it writes ---
python=$(python_with meshio)
if [ -n "$python" ]; then
    cat >write.py <<'END'
import meshio, numpy as np
points = [[545000.5, 5972000.123456789, 1.25], [545010, 5972000, 0.30000000000000004], [545010, 5972010, -2e-7], [545000, 5972010, 2], [545020, 5972000, 12345.678]]
cells = [('quad', np.array([[0, 1, 2, 3]])), ('triangle', np.array([[1, 4, 2]]))]
region = [np.array([3], dtype='int32'), np.array([7], dtype='int32')]
meshio.Mesh(points, cells, cell_data={'other': [np.zeros((1, 3)), np.ones((1, 3))], 'region': region}).write('meshio.vtk', file_format='vtk42', binary=False)
meshio.Mesh(points, cells, cell_data={'gmsh:physical': region, 'gmsh:geometrical': region}).write('meshio.msh', file_format='gmsh22', binary=False, float_fmt='.17g')
meshio.Mesh(points, cells).write('meshio.ply', file_format='ply', binary=False)
END
    "$python" write.py >meshio.log 2>&1
    grep -Ev '^#(name|string|crs)' quads.hm >want
    hmconv meshio.msh >got
    same "msh of meshio" want got
    hmconv meshio.vtk | sed 's/^#name.*//; /^$/d' >got
    same "vtk of meshio" want got
    sed -e 's/^\(q .*\) 3$/\1 0/' -e 's/^\(t .*\) 7$/\1 0/' want >want.ply
    hmconv meshio.ply >got
    same "ply of meshio" want.ply got
else
    skip "meshio is not there (python3-meshio)"
fi

# --- GDAL: the analysis grid there and back ---
if command -v gdal_translate >/dev/null; then
    hmconv -t asc dem.hm >dem.asc
    gdal_translate -q -ot Float64 -oo DATATYPE=Float64 dem.asc dem.tif >gdal.log 2>&1
    gdal_translate -q -of AAIGrid -co SIGNIFICANT_DIGITS=17 dem.tif back.asc >gdal.log 2>&1
    hmconv -t xyz dem.asc >want
    hmconv -t xyz back.asc >got
    same "every node of the grid through GeoTIFF" want got
    x=$(sed -n 's/^Origin = (\(.*\),.*)/\1/p' <<END
$(gdalinfo dem.asc)
END
)
    true_that "a corner half a cell outside the first node" \
        "($x + 1 - $(sed -n 's/^#origin \([^ ]*\) .*/\1/p' dem.hm)) ^ 2 < 1e-12"
    sed 's/^#data/#crs UTM 32N WGS84\n&/' dem.hm >utm.hm
    hmconv -t prj utm.hm >dem.prj
    ok "the zone beside it" sh -c 'gdalinfo dem.asc | grep -q "UTM zone 32N\|UTM_Zone_32N"'
    ok "as a code" sh -c 'gdalsrsinfo -o epsg dem.prj | grep -q EPSG:32632'
    printf '#hm 1 points text\n#crs EPSG:32733\n#data\n1 2 3\n#end\n' | hmconv -t prj >south.prj
    ok "in the south" sh -c 'gdalsrsinfo -o epsg south.prj | grep -q EPSG:32733'
    printf '#hm 1 points text\n#crs TM lon=9.25 lat=48 scale=0.9999 x=3500000 y=-20.5 WGS84\n#data\n0 0 3\n#end\n' >tm.hm
    hmconv -t prj tm.hm >tm.prj
    echo "3512345 6789" | gdaltransform -s_srs tm.prj -t_srs EPSG:4326 2>err | awk '{ printf "%.8f %.8f\n", $1, $2 }' >want
    sed 's/^0 0/3512345 6789/' tm.hm >place.hm
    if command -v georef >/dev/null; then
        georef -i place.hm | awk '/^[0-9]/ { printf "%.8f %.8f\n", $1, $2 }' >got
        same "a transverse Mercator of one's own" want got
    fi
else
    skip "gdal_translate is not there (gdal-bin)"
fi
done_testing
