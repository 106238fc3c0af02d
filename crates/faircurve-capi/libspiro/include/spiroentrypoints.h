/* spiroentrypoints.h: Spiro curves as Beziers. libspiro's interface, here with faircurve's solver behind
   it; see libspiro(3).
   SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef _SPIROENTRYPOINTS_H
#define _SPIROENTRYPOINTS_H

#include "bezctx.h"
#include "spiro.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Letters of points. Any other is a corner. */
#define SPIRO_CORNER            'v'     /* the curve may turn abruptly */
#define SPIRO_G4                'o'     /* curvature and its first two derivatives are continuous */
#define SPIRO_G2                'c'     /* curvature is continuous */
#define SPIRO_LEFT              '['     /* a curve comes in, a straight line leaves */
#define SPIRO_RIGHT             ']'     /* a straight line comes in, a curve leaves */
#define SPIRO_ANCHOR            'a'     /* the curve passes in the direction of the handle, the next point */
#define SPIRO_HANDLE            'h'     /* not on the curve; nothing without its anchor */

/* Marks of lists. */
#define SPIRO_OPEN_CONTOUR      '{'     /* the first point of an open contour */
#define SPIRO_END_OPEN_CONTOUR  '}'     /* the last point of an open contour */
#define SPIRO_END               'z'     /* after the last point of a closed one; its place means nothing */

/* Flags, to be or-ed together. */
#define SPIRO_INCLUDE_LAST_KNOT 0x0100  /* mark_knot at the end of an open contour, too */
#define SPIRO_INTERNAL_BEZCTX   0x0200  /* the receiver is an ls_bezctx */
#define SPIRO_RETRO_VER1        0x0400  /* run_spiro0 scales nothing */
#define SPIRO_REVERSE_SRC       0x0800  /* turn the list round first, in place */

/* One kind of pieces. */
#define SPIRO_ARC_CUB_QUAD_CLR  0x7FFF
#define SPIRO_ARC_CUB_QUAD_MASK 0x7000
#define SPIRO_CUBIC_TO_BEZIER   0x0000  /* cubics */
#define SPIRO_CUBIC_MIN_MAYBE   0x1000  /* fewer cubics, farther from the curve */
#define SPIRO_ARC_MAYBE         0x2000  /* circular arcs, by quadto */
#define SPIRO_ARC_MIN_MAYBE     0x3000  /* fewer arcs */
#define SPIRO_QUAD0_TO_BEZIER   0x4000  /* quadratics */

/* All of these solve a contour and draw it with the functions of bc. They return 1; or 0 if an array is
   NULL, n is not above 0, or a coordinate isn't a finite number: then no function has been called. What
   can't be solved as asked is drawn with something weaker at as few points as are found, and is a 1.

   Nothing is kept between calls: any number of threads may call at once, with lists and receivers of
   their own. */

/* A list that says itself where it ends: '{' ... '}' is open, ... 'z' closed. A list without an end mark is
   read beyond its end. */
extern int TaggedSpiroCPsToBezier2(spiro_cp *spiros, int ncq, bezctx *bc);

/* A list of n points; the letters of both ends of an open one mean nothing. A closed one may have its 'z',
   counted or not. One that starts with '{' is open, whatever isclosed says. */
extern int SpiroCPsToBezier2(spiro_cp *spiros, int n, int ncq, int isclosed, bezctx *bc);

/* Without flags. */
extern int TaggedSpiroCPsToBezier0(spiro_cp *spiros, bezctx *bc);
extern int SpiroCPsToBezier0(spiro_cp *spiros, int n, int isclosed, bezctx *bc);

/* The same with the answer in *done, unless that is NULL. */
extern void TaggedSpiroCPsToBezier1(spiro_cp *spiros, bezctx *bc, int *done);
extern void SpiroCPsToBezier1(spiro_cp *spiros, int n, int isclosed, bezctx *bc, int *done);

/* The same without an answer. */
extern void TaggedSpiroCPsToBezier(spiro_cp *spiros, bezctx *bc);
extern void SpiroCPsToBezier(spiro_cp *spiros, int n, int isclosed, bezctx *bc);

extern const char *LibSpiroVersion(void);

/* A receiver for SPIRO_INTERNAL_BEZCTX with room for max entries, to be freed with free_ls_bezctx. NULL if
   ncq lacks that flag, max is not above 0, or there is no memory. */
ls_bezctx *new_ls_bezctx(int max, int ncq);
void free_ls_bezctx(ls_bezctx *bd);

#ifdef __cplusplus
}
#endif
#endif
