/* VTK: the legacy form and XML (.vtu), both as text; regions as data of the cells. */
#include "hm_export_private.h"

enum { TRIANGLE = 5, QUAD = 9 };

static int cell_type(const struct hm_elem *e)
{
    return hm_elem_corners(e) == 3 ? TRIANGLE : QUAD;
}

static void put_points(struct hm_sink *s, const struct hm_mesh *m)
{
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_export_place(s, &m->node[k]);
        hm_sink_text(s, "\n");
    }
}

static void put_types(struct hm_sink *s, const struct hm_mesh *m)
{
    for (size_t k = 0; k < m->nelems; k++)
        hm_sink_format(s, "%d\n", cell_type(&m->elem[k]));
}

static void put_regions(struct hm_sink *s, const struct hm_mesh *m)
{
    for (size_t k = 0; k < m->nelems; k++)
        hm_sink_format(s, "%d\n", m->elem[k].region);
}

enum hm_err hm_export_vtk(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_sink s = hm_sink_to(w, d);
    size_t integers = 0;
    for (size_t k = 0; k < m->nelems; k++)
        integers += 1 + (size_t)hm_elem_corners(&m->elem[k]);
    hm_sink_format(&s, "# vtk DataFile Version 3.0\n%.200s\nASCII\nDATASET UNSTRUCTURED_GRID\n",
                   hm_export_name(m));
    hm_sink_format(&s, "POINTS %zu double\n", m->nnodes);
    put_points(&s, m);
    hm_sink_format(&s, "CELLS %zu %zu\n", m->nelems, integers);
    for (size_t k = 0; k < m->nelems; k++) {
        hm_sink_integer(&s, hm_elem_corners(&m->elem[k]));
        hm_export_corners(&s, &m->elem[k], 0);
        hm_sink_text(&s, "\n");
    }
    hm_sink_format(&s, "CELL_TYPES %zu\n", m->nelems);
    put_types(&s, m);
    hm_sink_format(&s, "CELL_DATA %zu\nSCALARS region int 1\nLOOKUP_TABLE default\n", m->nelems);
    put_regions(&s, m);
    return hm_sink_finish(&s);
}

static void begin_array(struct hm_sink *s, const char *type, const char *name, int components)
{
    hm_sink_format(s, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
    if (components > 1)
        hm_sink_format(s, " NumberOfComponents=\"%d\"", components);
    hm_sink_text(s, " format=\"ascii\">\n");
}

static void end_array(struct hm_sink *s)
{
    hm_sink_text(s, "</DataArray>\n");
}

static void put_cells(struct hm_sink *s, const struct hm_mesh *m)
{
    begin_array(s, "Int32", "connectivity", 1);
    for (size_t k = 0; k < m->nelems; k++) {
        hm_export_corners(s, &m->elem[k], 0);
        hm_sink_text(s, "\n");
    }
    end_array(s);
    begin_array(s, "Int64", "offsets", 1);
    int64_t offset = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        offset += hm_elem_corners(&m->elem[k]);
        hm_sink_integer(s, offset);
        hm_sink_text(s, "\n");
    }
    end_array(s);
    begin_array(s, "UInt8", "types", 1);
    put_types(s, m);
    end_array(s);
}

enum hm_err hm_export_vtu(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_text(&s, "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                     "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n");
    hm_sink_format(&s, "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<Points>\n",
                   m->nnodes, m->nelems);
    begin_array(&s, "Float64", "Points", 3);
    put_points(&s, m);
    end_array(&s);
    hm_sink_text(&s, "</Points>\n<Cells>\n");
    put_cells(&s, m);
    hm_sink_text(&s, "</Cells>\n<CellData Scalars=\"region\">\n");
    begin_array(&s, "Int32", "region", 1);
    put_regions(&s, m);
    end_array(&s);
    hm_sink_text(&s, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    return hm_sink_finish(&s);
}
