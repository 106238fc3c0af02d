/* faircurve.h: fair curves through points. The manual is docs/c-api.md in faircurve's repository, and
   faircurve(3).

   Every function may be called from any thread; a handle that is being changed or freed, by one thread at a
   time. Nothing is kept between calls but what handles hold. Pointers are checked for NULL only. Directions are in
   radians, counterclockwise; y is up.

   SPDX-License-Identifier: Apache-2.0 OR MIT
   Made by cbindgen of crates/faircurve-capi/src/lib.rs: change it there, then run cargo xtask header. */

#ifndef FAIRCURVE_H
#define FAIRCURVE_H

#include <stddef.h>

// Whatever the spline takes where nothing is said.
#define FC_JOIN_DEFAULT 0

// The curve may turn abruptly.
#define FC_JOIN_CORNER 1

// The direction is continuous.
#define FC_JOIN_G1 2

// Curvature is continuous, too.
#define FC_JOIN_G2 3

// Its first two derivatives are continuous, too.
#define FC_JOIN_G4 4

// A curve comes in; what leaves behaves as from an end, such as a straight line.
#define FC_JOIN_CURVE_TO_TERMINAL 5

// What comes in behaves as toward an end; a curve leaves.
#define FC_JOIN_TERMINAL_TO_CURVE 6

// What became of a call. fc_status_message says it in words.
typedef enum {
  // Done.
  FC_OK,
  // An argument is NULL that must not be.
  FC_NULL_ARGUMENT,
  // The options have a size or a value that means nothing.
  FC_BAD_OPTIONS,
  // The text is not a faircurve document.
  FC_BAD_DOCUMENT,
  // A contour can't be solved at all: a number in it has no meaning.
  FC_BAD_CONTOUR,
  // There is no spline of that name, or it lacks that parameter.
  FC_UNKNOWN_NAME,
  // A number is beyond what there is: of a contour, a knot, a relaxation, a join.
  FC_OUT_OF_RANGE,
  // The contour has no segment: it is a point.
  FC_NO_CURVE,
  // The array is too small.
  FC_TOO_SMALL,
  // faircurve has failed inside. Please report it.
  FC_BUG,
} fc_status;

// The kinds of pieces that a contour is made of.
typedef enum {
  // The contour starts at (x, y).
  FC_MOVE_TO,
  // A straight line to (x, y).
  FC_LINE_TO,
  // A quadratic Bézier with the control point (x1, y1), to (x, y).
  FC_QUAD_TO,
  // A cubic Bézier with the control points (x1, y1) and (x2, y2), to (x, y).
  FC_CUBIC_TO,
  // The contour is closed, and has come back to its start.
  FC_CLOSE,
} fc_element_kind;

// A drawing: contours of knots, and the spline that is to pass through them.
typedef struct fc_document fc_document;

// A drawing solved. Nothing of the document is used any more.
typedef struct fc_solution fc_solution;

// How to solve, and what Béziers to make. Filled by fc_options_default, then changed where need be.
typedef struct {
  // The size of this struct in the caller's eyes; later versions may have more members.
  size_t size;
  // The largest distance of the Béziers from the curve, in the drawing's units; 0, the default, is a
  // ten-thousandth of the larger side of each glyph.
  double accuracy;
  // How far to search where a contour is hard, as a multiple of the default, 1, which is about 50 ms a
  // contour at most. 0 is no search.
  double effort;
  // Not 0: a Bézier may run through knots at which the curve is smooth. Default 0.
  int span_knots;
  // Not 0: Béziers end where the curve is horizontal or vertical. Default 0.
  int at_extrema;
  // Not 0: Béziers end where the curve changes from bending to one side to bending to the other. Default 0.
  int at_inflections;
  // Not 0: ends of Béziers that aren't knots may lie off the curve, within the accuracy, so that there
  // are fewer. Default 0.
  int free_joints;
  // Not 0: where every curve as asked that was found loops (a segment is longer than four chords), one knot
  // or two are relaxed instead if that gives a curve without. Default 0.
  int no_loops;
} fc_options;

// A knot: a point that the curve passes through.
typedef struct {
  // Where it is, y up.
  double x;
  // Where it is, y up.
  double y;
  // How the curve joins there: one of FC_JOIN_…; at the ends of an open contour it means nothing.
  int join;
} fc_knot;

// A point of a curve.
typedef struct {
  // Where it is.
  double x;
  // Where it is.
  double y;
  // The direction of travel, in radians, counterclockwise from the x axis.
  double direction;
  // The curvature, in 1/units, positive where the curve bends to the left.
  double curvature;
} fc_point;

// A piece of a contour. Members that its kind doesn't use are 0.
typedef struct {
  // What it is.
  fc_element_kind kind;
  // The first control point.
  double x1;
  // The first control point.
  double y1;
  // The second control point.
  double x2;
  // The second control point.
  double y2;
  // Where it ends.
  double x;
  // Where it ends.
  double y;
} fc_element;

// Takes one piece after the other. The data is what was passed with the function.
typedef void (*fc_element_function)(const fc_element *element, void *data);

// Something that could not be met. The strings live as long as the solution.
typedef struct {
  // Not 0: index is that of a segment; 0: of a knot. Both count from 0.
  int is_segment;
  // Where it is.
  size_t index;
  // What was asked, such as "g4".
  const char *asked;
  // What holds instead, such as "g2".
  const char *got;
  // Why.
  const char *reason;
} fc_relaxation;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// faircurve's version, such as "0.1.0".
const char *fc_version(void);

// What a status says, in English. Never NULL, never to be freed.
const char *fc_status_message(int status);

// Frees a string that a function here has returned through a char **. NULL is nothing.
void fc_string_free(char *string);

// Fills options with the defaults. The size is sizeof(fc_options).
fc_status fc_options_default(fc_options *options, size_t size);

// A document without contours, to be solved with the spline "spiro". Never NULL.
fc_document *fc_document_new(void);

// Reads a document: JSON of so many bytes, which need not end in a NUL. On FC_OK *document is new; else it
// is NULL, and *message, unless message is NULL, a string that says what is wrong, where, and what to do.
fc_status fc_document_read_json(const char *text, size_t length, fc_document **document, char **message);

// Sets the spline of contours that don't name their own: a name such as "euler", of those that `faircurve
// list` shows.
fc_status fc_document_set_spline(fc_document *document, const char *name, char **message);

// Appends a contour to the last glyph, or to a new one without a name.
fc_status fc_document_add_contour(fc_document *document, const fc_knot *knots, size_t count, int is_closed);

// Writes a document as JSON: *json is a new string. Numbers that aren't finite are FC_BAD_DOCUMENT, with a
// *message as in fc_document_read_json.
fc_status fc_document_write_json(const fc_document *document, char **json, char **message);

// Frees a document. NULL is nothing.
void fc_document_free(fc_document *document);

// Solves every contour. NULL options are the defaults. On FC_OK *solution is new; else it is NULL, and *message,
// unless message is NULL, a string that says what is wrong, where, and what to do. What can't be solved as asked is
// relaxed, not an error: see fc_relaxation_count.
fc_status fc_solve(const fc_document *document,
                   const fc_options *options,
                   fc_solution **solution,
                   char **message);

// Writes a solution as JSON: *json is a new string. With samples above 0 every segment has that many equal
// parts of arc length, and points, directions and curvatures at their ends.
fc_status fc_solution_write_json(const fc_solution *solution, size_t samples, char **json);

// Frees a solution. NULL is nothing.
void fc_solution_free(fc_solution *solution);

// How many contours a solution has: those of all glyphs, in the document's order, counted from 0.
size_t fc_contour_count(const fc_solution *solution);

// The name of the glyph that a contour belongs to, empty if it has none. NULL if there is no such contour.
const char *fc_glyph_name(const fc_solution *solution, size_t contour);

// The name of its layer, empty if it has none. NULL if there is no such contour.
const char *fc_layer_name(const fc_solution *solution, size_t contour);

// The arc length of a contour, in the drawing's units.
fc_status fc_length(const fc_solution *solution, size_t contour, double *length);

// The arc length from the start of a contour to a knot. A closed contour of n knots has an n-th: its
// start, reached again.
fc_status fc_knot_position(const fc_solution *solution, size_t contour, size_t knot, double *s);

// Point, direction and curvature at an arc length from the start of a contour, clamped to its ends. Where
// two segments meet, those of the later one.
fc_status fc_at(const fc_solution *solution, size_t contour, double s, fc_point *point);

// Hands the pieces of a contour to a function, in order, with that data.
fc_status fc_beziers(const fc_solution *solution, size_t contour, fc_element_function function, void *data);

// Copies the pieces of a contour into an array that has room for so many. *count is how many pieces there are, on
// FC_TOO_SMALL, too; then nothing is copied. With a capacity of 0 the array may be NULL.
fc_status fc_beziers_into(const fc_solution *solution,
                          size_t contour,
                          fc_element *elements,
                          size_t capacity,
                          size_t *count);

// In how many places a contour could not be solved as asked; 0 if there is no such contour.
size_t fc_relaxation_count(const fc_solution *solution, size_t contour);

// One of these: where, what was asked, what holds instead, and why.
fc_status fc_relaxation_at(const fc_solution *solution,
                           size_t contour,
                           size_t index,
                           fc_relaxation *relaxation);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FAIRCURVE_H */
