/* UGRID: a mesh in NetCDF, the classic format, written by hand: magic, dimensions, variables with
 * their attributes and the place of their data, then the data, all big endian. Beyond 2 GB the
 * offsets have 64 bits (CDF-2). Numbers of nodes begin with 1; -1 fills up triangles. */
#include "hm_crs.h"
#include "hm_export_private.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum nc_tag { NC_DIMENSION = 10, NC_VARIABLE = 11, NC_ATTRIBUTE = 12 };
enum nc_type { NC_CHAR = 2, NC_INT = 4, NC_DOUBLE = 6 };
enum dim { NODES, FACES, EDGES, CORNERS, TWO, NDIMS };

/* An attribute: a text, or (text NULL) an integer. */
struct att {
    const char *name, *text;
    int32_t value;
};

enum { MOST_ATTS = 10 };

struct var {
    const char *name;
    enum nc_type type;
    int ndims;
    enum dim dim[2];
    struct att att[MOST_ATTS]; /* up to one without name */
};

enum { MESH, NODE_X, NODE_Y, NODE_Z, FACE_NODES, EDGE_NODES, REGION, SYSTEM, NVARS };

static const char *const dim_names[NDIMS] = {"mesh2d_nNodes", "mesh2d_nFaces", "mesh2d_nEdges",
                                             "mesh2d_nMax_face_nodes", "Two"};

static const struct var metric[NVARS] = {
    [MESH] = {"mesh2d",
              NC_INT,
              0,
              {0},
              {{"cf_role", "mesh_topology", 0},
               {"long_name", "Topology data of 2D mesh", 0},
               {"topology_dimension", NULL, 2},
               {"node_coordinates", "mesh2d_node_x mesh2d_node_y", 0},
               {"node_dimension", "mesh2d_nNodes", 0},
               {"face_node_connectivity", "mesh2d_face_nodes", 0},
               {"face_dimension", "mesh2d_nFaces", 0},
               {"edge_node_connectivity", "mesh2d_edge_nodes", 0},
               {"edge_dimension", "mesh2d_nEdges", 0}}},
    [NODE_X] = {"mesh2d_node_x",
                NC_DOUBLE,
                1,
                {NODES},
                {{"units", "m", 0},
                 {"standard_name", "projection_x_coordinate", 0},
                 {"long_name", "x-coordinate of mesh nodes", 0},
                 {"mesh", "mesh2d", 0},
                 {"location", "node", 0}}},
    [NODE_Y] = {"mesh2d_node_y",
                NC_DOUBLE,
                1,
                {NODES},
                {{"units", "m", 0},
                 {"standard_name", "projection_y_coordinate", 0},
                 {"long_name", "y-coordinate of mesh nodes", 0},
                 {"mesh", "mesh2d", 0},
                 {"location", "node", 0}}},
    [NODE_Z] = {"mesh2d_node_z",
                NC_DOUBLE,
                1,
                {NODES},
                {{"mesh", "mesh2d", 0},
                 {"location", "node", 0},
                 {"coordinates", "mesh2d_node_x mesh2d_node_y", 0},
                 {"standard_name", "altitude", 0},
                 {"long_name", "z-coordinate of mesh nodes", 0},
                 {"units", "m", 0},
                 {"grid_mapping", "projected_coordinate_system", 0}}},
    [FACE_NODES] = {"mesh2d_face_nodes",
                    NC_INT,
                    2,
                    {FACES, CORNERS},
                    {{"cf_role", "face_node_connectivity", 0},
                     {"mesh", "mesh2d", 0},
                     {"location", "face", 0},
                     {"long_name", "Mapping from every face to its corner nodes", 0},
                     {"start_index", NULL, 1},
                     {"_FillValue", NULL, -1}}},
    [EDGE_NODES] = {"mesh2d_edge_nodes",
                    NC_INT,
                    2,
                    {EDGES, TWO},
                    {{"cf_role", "edge_node_connectivity", 0},
                     {"mesh", "mesh2d", 0},
                     {"location", "edge", 0},
                     {"long_name", "Mapping from every edge to its two nodes", 0},
                     {"start_index", NULL, 1}}},
    [REGION] = {"mesh2d_face_region",
                NC_INT,
                1,
                {FACES},
                {{"mesh", "mesh2d", 0},
                 {"location", "face", 0},
                 {"long_name", "material number", 0}}},
    [SYSTEM] = {"projected_coordinate_system", NC_INT, 0, {0}, {{0}}}};

struct file {
    const struct hm_mesh *m;
    struct hm_mesh_edge *edge;
    int64_t length[NDIMS];
    struct var var[NVARS];
    size_t nvars; /* without SYSTEM when the crs is not said */
    bool wide;    /* offsets of 64 bits */
    int64_t begin[NVARS];
};

/* --- the header --- */

static void put_padding(struct hm_sink *s, size_t n)
{
    static const char zeros[4] = {0};
    hm_sink_bytes(s, zeros, (4 - n % 4) % 4);
}

static void put_name(struct hm_sink *s, const char *text)
{
    size_t n = strlen(text);
    hm_sink_be32(s, (uint32_t)n);
    hm_sink_bytes(s, text, n);
    put_padding(s, n);
}

static void put_atts(struct hm_sink *s, const struct att *att)
{
    uint32_t n = 0;
    while (n < MOST_ATTS && att[n].name)
        n++;
    hm_sink_be32(s, n ? NC_ATTRIBUTE : 0);
    hm_sink_be32(s, n);
    for (uint32_t i = 0; i < n; i++) {
        put_name(s, att[i].name);
        hm_sink_be32(s, att[i].text ? NC_CHAR : NC_INT);
        if (att[i].text) {
            put_name(s, att[i].text);
        } else {
            hm_sink_be32(s, 1);
            hm_sink_be32(s, (uint32_t)att[i].value);
        }
    }
}

static int64_t size_of(const struct file *f, const struct var *v)
{
    int64_t n = v->type == NC_DOUBLE ? 8 : 4;
    for (int i = 0; i < v->ndims; i++)
        n *= f->length[v->dim[i]];
    return n;
}

static void put_var(struct hm_sink *s, const struct file *f, size_t k)
{
    const struct var *v = &f->var[k];
    int64_t size = size_of(f, v);
    put_name(s, v->name);
    hm_sink_be32(s, (uint32_t)v->ndims);
    for (int i = 0; i < v->ndims; i++)
        hm_sink_be32(s, v->dim[i]);
    put_atts(s, v->att);
    hm_sink_be32(s, v->type);
    hm_sink_be32(s, size > UINT32_MAX - 3 ? UINT32_MAX : (uint32_t)size);
    if (f->wide)
        hm_sink_be64(s, (uint64_t)f->begin[k]);
    else
        hm_sink_be32(s, (uint32_t)f->begin[k]);
}

static void put_header(struct hm_sink *s, const struct file *f)
{
    static const struct att global[MOST_ATTS] = {
        {"Conventions", "CF-1.8 UGRID-1.0 Deltares-0.10", 0}};
    hm_sink_bytes(s, f->wide ? "CDF\2" : "CDF\1", 4);
    hm_sink_be32(s, 0); /* records */
    hm_sink_be32(s, NC_DIMENSION);
    hm_sink_be32(s, NDIMS);
    for (int i = 0; i < NDIMS; i++) {
        put_name(s, dim_names[i]);
        hm_sink_be32(s, (uint32_t)f->length[i]);
    }
    put_atts(s, global);
    hm_sink_be32(s, NC_VARIABLE);
    hm_sink_be32(s, (uint32_t)f->nvars);
    for (size_t k = 0; k < f->nvars; k++)
        put_var(s, f, k);
}

/* Where the data of each variable begin; the header is as long whatever these are. */
static void place_data(struct file *f)
{
    for (int wide = 0; wide < 2; wide++) {
        struct hm_sink counter = hm_sink_to(NULL, NULL);
        f->wide = wide;
        put_header(&counter, f);
        int64_t at = counter.written;
        for (size_t k = 0; k < f->nvars; k++) {
            f->begin[k] = at;
            at += size_of(f, &f->var[k]);
        }
        if (at <= INT32_MAX)
            return;
    }
}

/* --- the data --- */

static void put_faces(struct hm_sink *s, const struct file *f)
{
    for (size_t k = 0; k < f->m->nelems; k++)
        for (int i = 0; i < f->length[CORNERS]; i++) {
            int32_t node = f->m->elem[k].node[i];
            hm_sink_be32(s, (uint32_t)(node < 0 ? -1 : node + 1));
        }
}

static void put_data(struct hm_sink *s, const struct file *f)
{
    const struct hm_mesh *m = f->m;
    hm_sink_be32(s, 0); /* MESH: the value means nothing */
    for (size_t i = 0; i < m->nnodes; i++)
        hm_sink_be_double(s, m->node[i].x);
    for (size_t i = 0; i < m->nnodes; i++)
        hm_sink_be_double(s, m->node[i].y);
    for (size_t i = 0; i < m->nnodes; i++)
        hm_sink_be_double(s, m->node[i].z);
    put_faces(s, f);
    for (int64_t i = 0; i < f->length[EDGES]; i++) {
        hm_sink_be32(s, (uint32_t)f->edge[i].a + 1);
        hm_sink_be32(s, (uint32_t)f->edge[i].b + 1);
    }
    for (size_t k = 0; k < m->nelems; k++)
        hm_sink_be32(s, (uint32_t)m->elem[k].region);
    if (f->nvars > SYSTEM)
        hm_sink_be32(s, 0);
}

/* --- the system of coordinates --- */

static void set_system(struct file *f)
{
    const struct hm_header *h = &f->m->header;
    const char *text = hm_header_get(h, "crs");
    struct hm_diag ignored = {0};
    if (hm_header_need_metres(h, &ignored)) {
        f->var[NODE_X].att[0].text = "degrees_east";
        f->var[NODE_X].att[1].text = "longitude";
        f->var[NODE_Y].att[0].text = "degrees_north";
        f->var[NODE_Y].att[1].text = "latitude";
    }
    f->nvars = text ? SYSTEM + 1 : SYSTEM;
    if (!text) {
        f->var[NODE_Z].att[6] = (struct att){0};
        return;
    }
    int32_t epsg = hm_crs_epsg(text);
    f->var[SYSTEM].att[0] = (struct att){"name", text, 0};
    if (epsg > 0)
        f->var[SYSTEM].att[1] = (struct att){"epsg", NULL, epsg};
}

enum hm_err hm_export_ugrid(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct file f = {.m = m};
    size_t edges = 0;
    enum hm_err err = hm_mesh_edges(m, &f.edge, &edges, d);
    if (err)
        return err;
    memcpy(f.var, metric, sizeof metric);
    f.length[NODES] = (int64_t)m->nnodes;
    f.length[FACES] = (int64_t)m->nelems;
    f.length[EDGES] = (int64_t)edges;
    f.length[TWO] = 2;
    f.length[CORNERS] = 3;
    for (size_t k = 0; k < m->nelems && f.length[CORNERS] < 4; k++)
        f.length[CORNERS] = hm_elem_corners(&m->elem[k]);
    set_system(&f);
    place_data(&f);
    struct hm_sink s = hm_sink_to(w, d);
    put_header(&s, &f);
    put_data(&s, &f);
    free(f.edge);
    return hm_sink_finish(&s);
}
