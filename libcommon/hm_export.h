/* hm_export: objects written in the formats of other programs. Layer 6.
 *
 * Blanks separate, never tabs; lines end with LF. Numbers are the shortest that read back exactly,
 * or rounded to `decimals` places (0: exact).
 */
#ifndef HM_EXPORT_H
#define HM_EXPORT_H

#include "hm_inputs.h"
#include "hm_writer.h"

/* SMS 2dm: MESH2D, MESHNAME, ND id x y z, E3T id a b c material, E4Q …; ids from 1. Keys `#string
 * name n n …` of the header become node strings (NS). The region is the material number; 2dm has no
 * material 0, so region 0 becomes the number behind the largest region, and a card at the end, MAT
 * number "region 0", says so to the reader. HM_EGEOM names a node without height. */
enum hm_err hm_export_2dm(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

/* --- meshes for other programs ---
 *
 * All write the node strings of the header and the regions where the format has a place for them;
 * hmconv says what it has not. Ids from 1 unless the format counts from 0. Formats of triangles
 * (fort14, slf, tsh) want meshes without quadrilaterals. Heights are written as they are: depths,
 * positive down, are the caller's affair. */

/* UGRID 1.0 in classic NetCDF, for Delft3D FM, QGIS and others; carries the crs. */
enum hm_err hm_export_ugrid(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* RMA2/GFGEN .geo with mid-side nodes in the middle of the edges. HM_EARG when a line would pass 80
 * columns. Region 0 becomes the number behind the largest. */
enum hm_err hm_export_rma2(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* RMA-10S / Kalypso .2d: seven decimals. Region 0 becomes the number behind the largest. */
enum hm_err hm_export_kalypso(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* SCHISM hgrid.gr3, which as long as it has triangles only is ADCIRC's fort.14. Strings are open
 * boundaries, but those named wall, land, bank or island; the rest is land, in runs. */
enum hm_err hm_export_gr3(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* TELEMAC Selafin geometry, double precision; the conditions of its boundary, a line a node:
 * strings named inflow have the discharge given, other open ones the height of the water. */
enum hm_err hm_export_slf(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
enum hm_err hm_export_cli(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* VTK, legacy and XML, as text. */
enum hm_err hm_export_vtk(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
enum hm_err hm_export_vtu(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* Gmsh 2.2, text. */
enum hm_err hm_export_msh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* PLY, text. */
enum hm_err hm_export_ply(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* ANUGA .tsh. */
enum hm_err hm_export_tsh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* Medit .mesh, two dimensions: no heights. */
enum hm_err hm_export_medit(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* SRH-2D .srhgeom. */
enum hm_err hm_export_srh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

/* --- grids, points, lines --- */

/* ESRI ASCII grid of one band: north first, nodata -9999 (a longer row of nines when a height is
 * just that). HM_EARG when the cells are not square, or the grid has a single row or column. */
enum hm_err hm_export_asc(const struct hm_grid *g, size_t band, int decimals, struct hm_writer *w,
                          struct hm_diag *d);

/* .prj, ESRI's words for UTM, transverse Mercator, and longitude and latitude on WGS84; the text of
 * a
 * `#crs`. HM_EARG for any other. */
enum hm_err hm_export_prj(const char *crs, struct hm_writer *w, struct hm_diag *d);

/* A line "x y z" each; rows without z are left out and counted. */
enum hm_err hm_export_xyz(const double *rows, size_t n, size_t stride, int decimals,
                          int64_t *left_out, struct hm_writer *w, struct hm_diag *d);

/* Points with all their columns: names once (hm_export_csv_names), then a line with commas each;
 * what is missing is empty. */
enum hm_err hm_export_csv_names(char *const *fields, size_t n, struct hm_writer *w,
                                struct hm_diag *d);
enum hm_err hm_export_csv(const double *rows, size_t n, size_t stride, int decimals,
                          struct hm_writer *w, struct hm_diag *d);

/* GMT multisegment: "> attributes", a line "x y z" a vertex; the first vertex of a closed line is
 * repeated at its end. */
enum hm_err hm_export_gmt(const struct hm_line *line, int decimals, struct hm_writer *w,
                          struct hm_diag *d);

/* --- features for a GIS ---
 *
 * All points and lines of the inputs, points with their columns and lines with their attributes as
 * properties; closed lines are polygons. What lacks a height is written without; a line of which
 * only some vertices have one loses those, and *flat counts these lines. */

/* GeoJSON: with the member "crs" unless that is longitude and latitude; null when there is none. */
enum hm_err hm_export_geojson(const struct hm_inputs *in, int decimals, int64_t *flat,
                              struct hm_writer *w, struct hm_diag *d);
/* A table with commas, the geometries in a column WKT. */
enum hm_err hm_export_wkt(const struct hm_inputs *in, int decimals, int64_t *flat,
                          struct hm_writer *w, struct hm_diag *d);
/* OGR_GMT: GMT multisegment with attributes and crs (when it has an EPSG code) in comments; lines
 * alone, closed ones with the first vertex repeated. */
enum hm_err hm_export_ogrgmt(const struct hm_inputs *in, int decimals, struct hm_writer *w,
                             struct hm_diag *d);

/* --- Triangle --- */

/* .node: points, z and the further columns as attributes; or the nodes of a mesh of the inputs,
 * with a marker of 1 on its boundary. */
enum hm_err hm_export_node(const struct hm_inputs *in, struct hm_writer *w, struct hm_diag *d);
/* .ele: the elements of a mesh of triangles, their regions as an attribute. */
enum hm_err hm_export_ele(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
/* .poly: points and vertices of lines as nodes, those of one place once; a segment has the number
 * of its line, from 2, as a marker, and a comment before it says the attributes. Closed lines with
 * hole=1 make a hole, those with region= a region. *heights counts vertices whose height is that of
 * another at their place. */
enum hm_err hm_export_poly(const struct hm_inputs *in, int64_t *heights, struct hm_writer *w,
                           struct hm_diag *d);

#endif
