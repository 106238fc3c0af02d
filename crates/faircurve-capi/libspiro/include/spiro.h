/* spiro.h: solved segments of libspiro's interface, here with faircurve's solver behind it. Include
   spiroentrypoints.h, which includes this.
   SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef _SPIRO_H
#define _SPIRO_H

#include "bezctx.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A point of a contour, and the letter that says how the curve passes: see spiroentrypoints.h. */
typedef struct {
    double x;
    double y;
    char ty;
} spiro_cp;

/* A solved segment: curvature is a cubic polynomial of arc length, ks[0] + ks[1] s + ks[2] s^2 / 2 +
   ks[3] s^3 / 6 for s from -1/2 to 1/2, with the segment scaled to arc length 1. */
struct spiro_seg_s {
    double x;       /* where it starts: see dm of run_spiro0 */
    double y;
    char ty;        /* the letter of the point at which it starts */
    double bend_th; /* by how much the chords turn at that point, in radians; 0 at corners and ends */
    double ks[4];   /* zeros: a straight line */
    double seg_ch;  /* length of its chord, in the units of x and y */
    double seg_th;  /* direction of its chord, in radians */
    double l;       /* its arc length, in the units of x and y */
};

typedef struct spiro_seg_s spiro_seg;

/* Solves n points, the end mark included, and returns n segments, to be freed with free_spiro; NULL if n
   is not above 0 or a number isn't finite. The last entry, of the end mark, is only a place. At an anchor
   the straight "segment" to its handle comes first, which isn't part of the curve.

   dm, unless NULL, gets 3 numbers: scale, cx, cy. (x * scale + cx, y * scale + cy) is in your units: the
   larger side of the drawing is 500 long in those of the array, or nothing is scaled with
   SPIRO_RETRO_VER1. After a failure the scale is -1. */
spiro_seg *
run_spiro0(const spiro_cp *src, double *dm, int ncq, int n);

/* Draws such an array: 1, or 0 and no function has been called. src and n are those of run_spiro0. src may be
   NULL; then dm says where the points are; if it is NULL, too, they are in your units. */
int
spiro_to_bpath0(const spiro_cp *src, const spiro_seg *s,
                double *dm, int ncq, int n, bezctx *bc);

/* The direction at the end of segment i - 1, and for i = 0 at the start of segment 0: that in which the
   curve arrives at point i, in radians. */
double get_knot_th(const spiro_seg *s, int i);

/* Frees an array; NULL is nothing. */
void
free_spiro(spiro_seg *s);

/* The same in your units, without flags; for old programs. */
spiro_seg *
run_spiro(const spiro_cp *src, int n);

void
spiro_to_bpath(const spiro_seg *s, int n, bezctx *bc);

/* Turns a list of n points round, in place, so that it describes the same contour travelled the other way:
   a closing 'z' stays, '[' and ']' are exchanged. 0, or -1 if there is nothing to turn. */
int
spiroreverse(spiro_cp *src, int n);

/* "1.5", the libspiro that this takes the place of, then what it is in truth. */
const char *
LibSpiroVersion(void);

#ifdef __cplusplus
}
#endif
#endif
