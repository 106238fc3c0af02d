/* Calls everything in faircurve.h, with good and with bad arguments; prints what a test compares, and runs under
   valgrind. */
#include <faircurve.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures;
#define CHECK(claim) ((claim) ? (void)0 : (void)(failures++, printf("line %d: not so: %s\n", __LINE__, #claim)))

typedef struct { size_t count; fc_element last; } seen;
static void see(const fc_element *element, void *data)
{
    seen *s = data;
    s->count++, s->last = *element;
}

/* What an older header would have: the first two members after the size. */
typedef struct { size_t size; double accuracy; } old_options;

int main(int argc, char **argv)
{
    char *message = NULL, *json = NULL;
    fc_document *document = NULL, *again = NULL;
    fc_solution *solution = NULL;

    CHECK(strlen(fc_version()) > 0);
    for (int status = FC_OK; status <= FC_BUG; status++)
        CHECK(strlen(fc_status_message(status)) > 0);
    CHECK(strcmp(fc_status_message(99), "there is no such status") == 0);

    /* A circle of three knots, from an array and through JSON. */
    fc_knot knots[] = {{100, 0, FC_JOIN_DEFAULT}, {0, 100, FC_JOIN_G2}, {-100, 0, FC_JOIN_G4}};
    document = fc_document_new();
    CHECK(fc_document_add_contour(document, knots, 3, 1) == FC_OK);
    CHECK(fc_document_write_json(document, &json, NULL) == FC_OK);
    CHECK(fc_document_read_json(json, strlen(json), &again, &message) == FC_OK && message == NULL);
    fc_string_free(json);
    CHECK(fc_document_set_spline(again, "euler", &message) == FC_OK);

    fc_document *both[] = {document, again};
    for (int i = 0; i < 2; i++) {
        double length = 0, s = 0;
        fc_point point;
        CHECK(fc_solve(both[i], NULL, &solution, &message) == FC_OK && message == NULL);
        CHECK(fc_contour_count(solution) == 1 && strcmp(fc_glyph_name(solution, 0), "") == 0);
        CHECK(strcmp(fc_layer_name(solution, 0), "") == 0 && fc_glyph_name(solution, 1) == NULL);
        CHECK(fc_length(solution, 0, &length) == FC_OK && fabs(length - 200 * M_PI) < 1e-9);
        CHECK(fc_knot_position(solution, 0, 1, &s) == FC_OK && fabs(s - 50 * M_PI) < 1e-9);
        CHECK(fc_at(solution, 0, s, &point) == FC_OK);
        CHECK(fabs(point.x) < 1e-9 && fabs(point.y - 100) < 1e-9 && fabs(point.curvature - 0.01) < 1e-12);
        CHECK(fabs(fabs(remainder(point.direction, 2 * M_PI)) - M_PI) < 1e-9);
        CHECK(fc_knot_position(solution, 0, 3, &s) == FC_OK && s == length);
        CHECK(fc_knot_position(solution, 0, 4, &s) == FC_OUT_OF_RANGE);
        CHECK(fc_at(solution, 0, NAN, &point) == FC_OUT_OF_RANGE);
        CHECK(fc_at(solution, 1, 0, &point) == FC_OUT_OF_RANGE);
        CHECK(fc_relaxation_count(solution, 0) == 0 && fc_relaxation_count(solution, 9) == 0);

        /* By function and into an array: the same. */
        seen s1 = {0};
        size_t count = 0;
        CHECK(fc_beziers(solution, 0, see, &s1) == FC_OK && s1.last.kind == FC_CLOSE);
        CHECK(fc_beziers_into(solution, 0, NULL, 0, &count) == FC_TOO_SMALL && count == s1.count);
        fc_element *elements = malloc(count * sizeof *elements);
        CHECK(fc_beziers_into(solution, 0, elements, count - 1, &count) == FC_TOO_SMALL);
        CHECK(fc_beziers_into(solution, 0, elements, count, &count) == FC_OK);
        CHECK(elements[0].kind == FC_MOVE_TO && elements[0].x == 100 && elements[0].y == 0);
        CHECK(elements[count - 2].kind == FC_CUBIC_TO && elements[count - 2].x == 100);
        free(elements);
        CHECK(fc_beziers(solution, 0, NULL, NULL) == FC_NULL_ARGUMENT);

        CHECK(fc_solution_write_json(solution, 2, &json) == FC_OK && strstr(json, "\"samples\"") != NULL);
        fc_string_free(json);
        CHECK(fc_solution_write_json(solution, (size_t)-1, &json) == FC_OUT_OF_RANGE && json == NULL);
        fc_solution_free(solution);
    }
    fc_document_free(again);

    /* Options: defaults, an older caller's, and those that mean nothing. */
    fc_options options;
    size_t loose, tight;
    CHECK(fc_options_default(&options, sizeof options) == FC_OK && options.size == sizeof options);
    CHECK(options.effort == 1 && options.accuracy == 0 && options.span_knots == 0);
    options.accuracy = 10, options.span_knots = 1;
    CHECK(fc_solve(document, &options, &solution, NULL) == FC_OK);
    fc_beziers_into(solution, 0, NULL, 0, &loose);
    fc_solution_free(solution);
    old_options old;
    CHECK(fc_options_default((fc_options *)&old, sizeof old) == FC_OK && old.size == sizeof old);
    old.accuracy = 1e-9;
    CHECK(fc_solve(document, (fc_options *)&old, &solution, NULL) == FC_OK);
    fc_beziers_into(solution, 0, NULL, 0, &tight);
    CHECK(tight > loose);
    fc_solution_free(solution);
    CHECK(fc_options_default(&options, 1) == FC_BAD_OPTIONS);
    CHECK(fc_options_default(NULL, sizeof options) == FC_NULL_ARGUMENT);
    options.size = 0;
    CHECK(fc_solve(document, &options, &solution, &message) == FC_BAD_OPTIONS && solution == NULL);
    CHECK(strstr(message, "hint: ") != NULL);
    fc_string_free(message);
    options.size = sizeof options, options.accuracy = -1;
    CHECK(fc_solve(document, &options, &solution, &message) == FC_BAD_OPTIONS);
    CHECK(strncmp(message, "error: accuracy can't be -1\nhint: ", 34) == 0);
    fc_string_free(message);

    /* Documents and contours that mean nothing. */
    const char *text = "{\"faircurve\": 1, \"contours\": [{\"knots\": [{\"x\": 0, \"yy\": 1}]}]}";
    CHECK(fc_document_read_json(text, strlen(text), &again, &message) == FC_BAD_DOCUMENT && again == NULL);
    CHECK(strstr(message, "`yy`") != NULL && strstr(message, "hint: ") != NULL);
    fc_string_free(message);
    CHECK(fc_document_read_json(NULL, 5, &again, &message) == FC_NULL_ARGUMENT);
    CHECK(strcmp(message, "error: an argument is NULL that must not be") == 0);
    fc_string_free(message);
    CHECK(fc_document_read_json(NULL, 0, &again, NULL) == FC_BAD_DOCUMENT);
    CHECK(fc_document_set_spline(document, "spirro", &message) == FC_UNKNOWN_NAME);
    CHECK(strstr(message, "`spiro`") != NULL);
    fc_string_free(message);
    knots[1].join = 77;
    CHECK(fc_document_add_contour(document, knots, 3, 1) == FC_OUT_OF_RANGE);
    CHECK(fc_document_add_contour(document, NULL, 3, 1) == FC_NULL_ARGUMENT);
    CHECK(fc_document_add_contour(NULL, knots, 3, 1) == FC_NULL_ARGUMENT);
    knots[1] = (fc_knot){NAN, 0, FC_JOIN_DEFAULT};
    CHECK(fc_document_add_contour(document, knots, 3, 0) == FC_OK);
    CHECK(fc_solve(document, NULL, &solution, &message) == FC_BAD_CONTOUR && solution == NULL);
    CHECK(strstr(message, "contour 1: x of knot 1 is not a finite number") != NULL);
    fc_string_free(message);
    CHECK(fc_document_write_json(document, &json, &message) == FC_BAD_DOCUMENT && json == NULL);
    fc_string_free(message);
    fc_document_free(document);

    /* A point has no curve. */
    document = fc_document_new();
    CHECK(fc_document_add_contour(document, knots, 1, 0) == FC_OK);
    CHECK(fc_solve(document, NULL, &solution, NULL) == FC_OK);
    fc_point point;
    CHECK(fc_at(solution, 0, 0, &point) == FC_NO_CURVE);
    fc_solution_free(solution);
    fc_document_free(document);

    /* Something that can't be met is listed: a spiral that takes a search, without one. */
    char hard[20000];
    FILE *file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    size_t bytes = file ? fread(hard, 1, sizeof hard, file) : 0;
    if (file)
        fclose(file);
    fc_options_default(&options, sizeof options);
    for (int effort = 0; effort < 2; effort++) {
        size_t relaxed = 0;
        options.effort = effort;
        CHECK(fc_document_read_json(hard, bytes, &document, NULL) == FC_OK);
        CHECK(fc_solve(document, &options, &solution, NULL) == FC_OK);
        for (size_t contour = 0; contour < fc_contour_count(solution); contour++) {
            size_t here = fc_relaxation_count(solution, contour);
            fc_relaxation r;
            for (size_t i = 0; i < here; i++) {
                CHECK(fc_relaxation_at(solution, contour, i, &r) == FC_OK);
                CHECK(strlen(r.reason) > 0 && strcmp(r.asked, r.got) != 0);
            }
            CHECK(fc_relaxation_at(solution, contour, here, &r) == FC_OUT_OF_RANGE);
            relaxed += here;
        }
        CHECK((relaxed > 0) == (effort == 0));
        fc_solution_free(solution);
        fc_document_free(document);
    }

    /* What has to loop as asked is relaxed at one place or two instead, when loops aren't wanted. */
    const fc_knot line[] = {{0, 0, FC_JOIN_G4}, {-36, 76, FC_JOIN_G4}, {-51, 215, FC_JOIN_G4}, {-37, 336, FC_JOIN_G4}};
    fc_options_default(&options, sizeof options);
    document = fc_document_new();
    CHECK(fc_document_add_contour(document, line, 4, 1) == FC_OK);
    for (int no_loops = 0; no_loops < 2; no_loops++) {
        options.no_loops = no_loops;
        CHECK(fc_solve(document, &options, &solution, NULL) == FC_OK);
        size_t relaxed = fc_relaxation_count(solution, 0);
        CHECK(no_loops ? relaxed == 1 || relaxed == 2 : relaxed == 0);
        fc_solution_free(solution);
    }
    fc_document_free(document);

    fc_document_free(NULL), fc_solution_free(NULL), fc_string_free(NULL);
    CHECK(fc_contour_count(NULL) == 0 && fc_glyph_name(NULL, 0) == NULL);
    CHECK(fc_solve(NULL, NULL, &solution, NULL) == FC_NULL_ARGUMENT);
    printf("%d failures\n", failures);
    return failures != 0;
}
