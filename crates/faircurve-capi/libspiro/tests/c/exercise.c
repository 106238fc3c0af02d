/* Calls everything that libspiro's interface has, with good and with bad arguments; prints what a test compares,
   and runs under valgrind. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <spiroentrypoints.h>

static int failures;
#define CHECK(claim) ((claim) ? (void)0 : (void)(failures++, printf("line %d: not so: %s\n", __LINE__, #claim)))

/* A receiver with data of its own after the functions. */
typedef struct {
    bezctx base;
    int moves, lines, quads, cubics, knots, last_knot, is_open;
    double x, y, start_x, start_y;
} counter;

static void moveto(bezctx *bc, double x, double y, int is_open)
{
    counter *c = (counter *)bc;
    c->moves++, c->is_open = is_open, c->x = c->start_x = x, c->y = c->start_y = y;
}
static void lineto(bezctx *bc, double x, double y)
{
    counter *c = (counter *)bc;
    c->lines++, c->x = x, c->y = y;
}
static void quadto(bezctx *bc, double x1, double y1, double x2, double y2)
{
    counter *c = (counter *)bc;
    c->quads++, c->x = x2, c->y = y2;
}
static void curveto(bezctx *bc, double x1, double y1, double x2, double y2, double x3, double y3)
{
    counter *c = (counter *)bc;
    c->cubics++, c->x = x3, c->y = y3;
}
static void mark_knot(bezctx *bc, int knot)
{
    counter *c = (counter *)bc;
    c->knots++, c->last_knot = knot;
}

static counter receiver(void)
{
    counter c;
    memset(&c, 0, sizeof c);
    c.base = (bezctx){moveto, lineto, quadto, curveto, mark_knot};
    return c;
}
static int calls(const counter *c) { return c->moves + c->lines + c->quads + c->cubics + c->knots; }

#define RING {500, 250, 'o'}, {250, 500, 'o'}, {0, 250, 'o'}, {250, 0, 'o'}

int main(void)
{
    spiro_cp ring[] = {RING, {0, 0, 'z'}};
    spiro_cp open[] = {{0, 0, '{'}, {100, 100, 'o'}, {200, 0, 'v'}, {300, 50, '}'}};
    int done = 7;
    counter c;

    CHECK(strncmp(LibSpiroVersion(), "1.5", 3) == 0);

    /* Every entry point draws the ring. */
    for (int entry = 0; entry < 8; entry++) {
        c = receiver();
        switch (entry) {
        case 0: TaggedSpiroCPsToBezier(ring, &c.base); break;
        case 1: CHECK(TaggedSpiroCPsToBezier0(ring, &c.base) == 1); break;
        case 2: TaggedSpiroCPsToBezier1(ring, &c.base, &done); CHECK(done == 1); break;
        case 3: CHECK(TaggedSpiroCPsToBezier2(ring, 0, &c.base) == 1); break;
        case 4: SpiroCPsToBezier(ring, 4, 1, &c.base); break;
        case 5: CHECK(SpiroCPsToBezier0(ring, 4, 1, &c.base) == 1); break;
        case 6: SpiroCPsToBezier1(ring, 4, 1, &c.base, NULL); break;
        case 7: CHECK(SpiroCPsToBezier2(ring, 5, 0, 1, &c.base) == 1); break;
        }
        CHECK(c.moves == 1 && c.cubics == 4 && c.lines == 0 && c.quads == 0);
        CHECK(c.knots == 4 && c.last_knot == 3 && !c.is_open);
        CHECK(c.x == c.start_x && c.y == c.start_y);
    }

    /* NULL arrays, no points, NaN: 0, and nothing is called. */
    c = receiver();
    spiro_cp nan_ring[] = {RING, {0, 0, 'z'}};
    nan_ring[2].y = NAN;
    CHECK(TaggedSpiroCPsToBezier0(NULL, &c.base) == 0);
    CHECK(TaggedSpiroCPsToBezier2(ring, 0, NULL) == 0);
    CHECK(SpiroCPsToBezier0(NULL, 4, 1, &c.base) == 0);
    CHECK(SpiroCPsToBezier0(ring, 0, 1, &c.base) == 0);
    CHECK(SpiroCPsToBezier0(ring, -3, 1, &c.base) == 0);
    CHECK(TaggedSpiroCPsToBezier0(nan_ring, &c.base) == 0);
    TaggedSpiroCPsToBezier1(nan_ring, &c.base, &done);
    CHECK(done == 0 && calls(&c) == 0);
    CHECK(run_spiro(NULL, 4) == NULL && run_spiro(ring, 0) == NULL && run_spiro(nan_ring, 5) == NULL);
    CHECK(spiro_to_bpath0(NULL, NULL, NULL, 0, 3, &c.base) == 0 && calls(&c) == 0);
    CHECK(get_knot_th(NULL, 0) == 0.0);
    CHECK(spiroreverse(NULL, 3) == -1 && spiroreverse(ring, 0) == -1);
    free_spiro(NULL);
    free_ls_bezctx(NULL);

    /* Any callback may be NULL. */
    for (int missing = 0; missing < 32; missing++) {
        c = receiver();
        if (missing & 1) c.base.moveto = NULL;
        if (missing & 2) c.base.lineto = NULL;
        if (missing & 4) c.base.quadto = NULL;
        if (missing & 8) c.base.curveto = NULL;
        if (missing & 16) c.base.mark_knot = NULL;
        CHECK(TaggedSpiroCPsToBezier2(open, 0, &c.base) == 1);
        CHECK(c.moves == !(missing & 1) && c.lines == !(missing & 2) && c.quads == 0);
        CHECK((c.cubics > 0) == !(missing & 8) && c.knots == (missing & 16 ? 0 : 3));
    }

    /* Flags. */
    c = receiver();
    CHECK(TaggedSpiroCPsToBezier2(open, SPIRO_INCLUDE_LAST_KNOT, &c.base) == 1);
    CHECK(c.knots == 4 && c.last_knot == 3 && c.is_open == 1);
    for (int kind = 0; kind < 8; kind++) {
        c = receiver();
        CHECK(TaggedSpiroCPsToBezier2(open, kind << 12, &c.base) == 1);
        CHECK(c.lines == 1 && (kind < 2 ? c.cubics > 0 && c.quads == 0 : c.quads > 0 && c.cubics == 0));
    }
    c = receiver();
    spiro_cp turned[] = {{0, 0, '{'}, {100, 100, 'o'}, {200, 0, '['}, {300, 50, '}'}};
    CHECK(TaggedSpiroCPsToBezier2(turned, SPIRO_REVERSE_SRC, &c.base) == 1);
    CHECK(c.start_x == 300 && c.x == 0 && turned[0].x == 300 && turned[1].ty == ']');
    CHECK(spiroreverse(turned, 4) == 0 && turned[0].x == 0 && turned[2].ty == '[');

    /* Solved segments, scaled and not, drawn with and without the points. */
    for (int ncq = 0; ncq <= SPIRO_RETRO_VER1; ncq += SPIRO_RETRO_VER1) {
        double dm[3];
        spiro_seg *s = run_spiro0(ring, dm, ncq, 5);
        CHECK(s != NULL);
        CHECK(fabs(s[0].ks[0] - M_PI / 2) < 1e-9 && fabs(s[0].ks[1]) < 1e-9);
        CHECK(fabs(s[1].x * dm[0] + dm[1] - 250) < 1e-9 && fabs(s[1].y * dm[0] + dm[2] - 500) < 1e-9);
        CHECK(fabs(get_knot_th(s, 0) - M_PI / 2) < 1e-9 && fabs(fabs(get_knot_th(s, 1)) - M_PI) < 1e-9);
        for (int with = 0; with < 2; with++) {
            c = receiver();
            CHECK(spiro_to_bpath0(with ? ring : NULL, s, dm, ncq, 5, &c.base) == 1);
            CHECK(c.cubics == 4 && c.knots == 4 && c.x == c.start_x && c.y == c.start_y);
        }
        free_spiro(s);
    }
    spiro_seg *s = run_spiro(open, 4);
    CHECK(s != NULL && s[0].x == 0 && s[1].x == 100 && s[2].ks[0] == 0);
    c = receiver();
    spiro_to_bpath(s, 4, &c.base);
    CHECK(c.lines == 1 && c.is_open == 1 && fabs(c.x - 300) < 1e-9);
    free_spiro(s);

    /* The array in place of functions: filled, appended to, overflowing. */
    CHECK(new_ls_bezctx(0, SPIRO_INTERNAL_BEZCTX) == NULL && new_ls_bezctx(-1, SPIRO_INTERNAL_BEZCTX) == NULL);
    CHECK(new_ls_bezctx(9, 0) == NULL);
    int flags = SPIRO_INTERNAL_BEZCTX | SPIRO_INCLUDE_LAST_KNOT;
    ls_bezctx *kept = new_ls_bezctx(18, flags);
    CHECK(kept != NULL && kept->l == 0 && kept->max == 18);
    CHECK(TaggedSpiroCPsToBezier2(ring, flags, &kept->base) == 1);
    CHECK(kept->l == 9 && kept->is_open == 0);
    CHECK(kept->cd[0].ty == 'm' && kept->cd[1].ty == 'k' && kept->cd[2].ty == 'c');
    CHECK(kept->cd[0].x1 == 500 && kept->cd[1].x0 == 500 && kept->cd[2].x0 == 500 && kept->cd[2].y3 == 500);
    CHECK(kept->cd[8].x3 == 500 && kept->cd[8].y3 == 250);
    CHECK(TaggedSpiroCPsToBezier2(ring, flags, &kept->base) == 1 && kept->l == 18 && kept->cd[9].ty == 'm');
    CHECK(kept->cd[9].x0 == 500 && kept->cd[9].y0 == 250);
    CHECK(TaggedSpiroCPsToBezier2(open, flags, &kept->base) == 1 && kept->l == -1 && kept->is_open == 1);
    free_ls_bezctx(kept);

    printf("%d failures\n", failures);
    return failures != 0;
}
