/* bezctx.h: what receives the curves of libspiro, here with faircurve's solver behind it.
   SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef _BEZCTX_H
#define _BEZCTX_H

#ifdef __cplusplus
extern "C" {
#endif

/* A receiver: five functions, each of which may be NULL. To keep data of your own, make a struct whose
   first member is a bezctx, and pass its address; the functions get that same address.

   One contour is: moveto; then for each stretch from one point to the next mark_knot, with the number of
   the point at which it starts, and the pieces of the stretch. */
typedef struct _bezctx bezctx;

struct _bezctx {
    /* A contour starts at (x, y). is_open is 1 if it is open; a closed one ends where it started, to
       the bit, without a further call. */
    void (*moveto)(bezctx *bc, double x, double y, int is_open);

    /* A straight line to (x, y). */
    void (*lineto)(bezctx *bc, double x, double y);

    /* A quadratic Bezier with the control point (x1, y1), ending in (x2, y2). With SPIRO_ARC_MAYBE and
       SPIRO_ARC_MIN_MAYBE instead the circular arc through (x1, y1) to (x2, y2). */
    void (*quadto)(bezctx *bc, double x1, double y1, double x2, double y2);

    /* A cubic Bezier with the control points (x1, y1) and (x2, y2), ending in (x3, y3). */
    void (*curveto)(bezctx *bc, double x1, double y1, double x2, double y2,
                    double x3, double y3);

    /* The point of that number, counted from 0, is where the pen is. Handles ('h') don't count. */
    void (*mark_knot)(bezctx *bc, int knot_idx);
};

/* With SPIRO_INTERNAL_BEZCTX no functions are called; an array is filled. One entry is a call: its ty
   says which, and the points are in order, first the one at which the pen was.

     'm'  moveto      (x0, y0) before, (x1, y1) the start
     'l'  lineto      (x0, y0) to (x1, y1)
     'q'  quadto      (x0, y0), (x1, y1) the control point or that on the arc, (x2, y2)
     'c'  curveto     (x0, y0), (x1, y1) and (x2, y2) the control points, (x3, y3)
     'k'  mark_knot   (x0, y0) the knot                                                       */
typedef struct {
    char ty;
    double x0, y0, x1, y1, x2, y2, x3, y3;
} curve_data;

/* Made by new_ls_bezctx, freed by free_ls_bezctx. Contours are appended. */
typedef struct {
    bezctx base;    /* all NULL */
    curve_data *cd; /* the entries */
    int l;          /* how many there are; -1 once one didn't fit */
    int max;        /* how many fit */
    int is_open;    /* 1 if the last contour is open */
} ls_bezctx;

#ifdef __cplusplus
}
#endif
#endif
