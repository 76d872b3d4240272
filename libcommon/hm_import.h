/* hm_import: meshes of other programs, points and lines of a GIS. Layer 6.
 *
 * For hm_reader_foreign. Nodes may have any ids; every fault names the file and the line, or the
 * byte. What goes along: regions, node strings and the crs, where the format has them. Elements of
 * other shapes than triangles and quadrilaterals are an error.
 */
#ifndef HM_IMPORT_H
#define HM_IMPORT_H

#include "hm_mesh.h"
#include "hm_reader.h"

/* UGRID in classic NetCDF, SCHISM gr3 and ADCIRC fort.14 (depths become heights, open boundaries
 * the node strings open1, open2 …), Selafin of single and double precision, Kalypso .2d, Gmsh 2.2
 * text, PLY text, VTK legacy text; GeoJSON (with jansson; else it is refused), WKT, Triangle's
 * .node alone or before .ele or .poly, .poly. Ends with a NULL name. */
extern const struct hm_foreign hm_import_formats[];

/* The same without GeoJSON, for programs that need no other library. */
extern const struct hm_foreign hm_import_plain[];

#endif
