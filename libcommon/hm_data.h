/* hm_data: whole objects, from streams into memory and back. Layer 5.
 *
 * The read functions fill an empty container. They expect that hm_reader_next has just given `h`,
 * which they take over (on failure as well: the caller frees the container, never h). Write
 * functions write one object.
 */
#ifndef HM_DATA_H
#define HM_DATA_H

#include "hm_grid.h"
#include "hm_line.h"
#include "hm_mesh.h"
#include "hm_points.h"
#include "hm_reader.h"
#include "hm_writer.h"

enum hm_err hm_points_read(struct hm_points *p, struct hm_reader *r, struct hm_header *h,
                           struct hm_diag *d);
/* The same in steps, for those who tell how far it is: take h over, then add some until HM_END.
 */
void hm_points_begin(struct hm_points *p, struct hm_header *h);
enum hm_err hm_points_more(struct hm_points *p, struct hm_reader *r, struct hm_diag *d);
enum hm_err hm_points_write(const struct hm_points *p, struct hm_writer *w, struct hm_diag *d);

enum hm_err hm_grid_read(struct hm_grid *g, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d);
enum hm_err hm_grid_write(const struct hm_grid *g, struct hm_writer *w, struct hm_diag *d);

enum hm_err hm_lines_read(struct hm_lines *l, struct hm_reader *r, struct hm_header *h,
                          struct hm_diag *d);
enum hm_err hm_lines_write(const struct hm_lines *l, struct hm_writer *w, struct hm_diag *d);

enum hm_err hm_mesh_read(struct hm_mesh *m, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d);
enum hm_err hm_mesh_write(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

#endif
